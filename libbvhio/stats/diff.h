// Reports how two scenes with their trees differ: in the order of nodes, boxes, topology, or the geometry
// itself.
#pragma once

#include <string>
#include <vector>

#include "compress/forms.h"
#include "core/report_fwd.h"
#include "scene/scene.h"
#include "tree/sah_cost.h"

namespace bvhio {

/// The aspects in which two files can differ, from harmless to grave.
///
/// - form: nodes are stored in different forms.
/// - costs: the trees were built for different SAH costs.
/// - order: nodes, siblings or the triangles in leaves are in another order. A relayout may change only this.
/// - boxes: triangles are grouped in the same way, but in other boxes. Compared only if the topologies are
///   equal.
/// - topology: triangles are grouped differently.
/// - geometry: vertices, triangles or their ids differ.
enum class Aspect { form, costs, order, boxes, topology, geometry };
std::string_view nameOf(Aspect aspect);

struct Difference {
    Aspect aspect;
    std::string first;  // the first difference, in one line: "vertex 12: (0, 0, 1) and (0, 0, 2)"
    uint64_t count;  // of differences: of nodes, or of vertices and triangles if both sides have equally many
};

/// One side of a comparison: the content of a file.
struct DiffSide {
    const Scene& scene;
    const EncodedBvh& encoded;
    SahCosts costs{};
};

/// Returns all differences, at most one for each aspect, in the order of Aspect; none if both sides have the
/// same bits. Trees are compared after decoding.
std::vector<Difference> differences(const DiffSide& a, const DiffSide& b);

/// Returns the keys verdict ("identical", or the name of the gravest aspect), differences[]{aspect, first,
/// count}, and a and b, each with form, layout, primitives, nodes, sah_cost and the three hashes.
/// shared_subtrees counts the nodes of a that group triangles in the same way as a node of b. largest_shift
/// is the largest distance between vertices of the same index (null if the vertex counts differ).
Report diffReport(const DiffSide& a, const DiffSide& b);

}  // namespace bvhio
