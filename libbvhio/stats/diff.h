// What sets two scenes with their trees apart: the order of nodes, boxes, grouping, or the geometry itself.
#pragma once

#include <string>
#include <vector>

#include "compress/forms.h"
#include "core/report.h"
#include "scene/scene.h"
#include "tree/sah_cost.h"

namespace bvhio {

/// Where two files can differ, from harmless to grave. Each tells its own story:
/// form: nodes are stored in different forms.
/// costs: the trees were built for other SAH costs.
/// order: nodes, siblings or the triangles in leaves lie in another order, which is all that a relayout may
/// change. boxes: the same grouping of triangles in other boxes. Only looked at where the topologies are
/// equal. topology: triangles are grouped otherwise. geometry: vertices, triangles or their ids.
enum class Aspect { form, costs, order, boxes, topology, geometry };
std::string_view nameOf(Aspect aspect);

struct Difference {
    Aspect aspect;
    std::string first;  // the first place that differs, in one line: "vertex 12: (0, 0, 1) and (0, 0, 2)"
    uint64_t
        count;  // how many places differ: of nodes, or of vertices and triangles when their numbers are equal
};

/// One side of a comparison: what a file holds.
struct DiffSide {
    const Scene& scene;
    const EncodedBvh& encoded;
    SahCosts costs{};
};

/// All differences, at most one for each aspect, in the order of Aspect; none when both sides are the same
/// bit by bit. Forms are compared as decoded.
std::vector<Difference> differences(const DiffSide& a, const DiffSide& b);

/// The keys verdict ("identical", or the name of the gravest aspect), differences[]{aspect, first, count},
/// and a and b, each with form, layout, primitives, nodes, sah_cost and the three hashes; shared_subtrees
/// counts the nodes of a that group triangles as some node of b does, and largest_shift is the longest way
/// between vertices of one number (null when the numbers of vertices differ).
Report diffReport(const DiffSide& a, const DiffSide& b);

}  // namespace bvhio
