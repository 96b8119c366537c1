// Builds the trees of the mvh form: which primitives go left, and the codes of nodes.
#pragma once

#include <span>
#include <vector>

#include "compress/mvh_tree.h"

namespace bvhio {

/// A primitive and its box, as builders move them around: two vectors of four lanes.
struct alignas(16) MvhReference {
    Vec3 min;
    uint32_t primitive;
    Vec3 max;
    uint32_t unused = 0;

    MvhReference() = default;
    MvhReference(const Aabb& box, uint32_t id) : min(box.min), primitive(id), max(box.max) {}
    Aabb box() const { return {min, max}; }
};
static_assert(sizeof(MvhReference) == 32);

/// The boxes of all triangles, in their order.
std::vector<MvhReference> mvhReferences(const Scene& scene);

/// Puts a run of references, 1 at least, into the order of a tree's leaves. `root` is the box that the tree's
/// root will have; it contains every reference's. The paper's build halves by centroid along the longest axis
/// of the node's box as reconstructed; the best build tries all axes, by centroid, low and high side, and
/// keeps the split of least count * (area as reconstructed + the same when cut once more + 2 * tight area).
/// Deterministic; parallel when the run is long, and fast: about 1 us a reference.
void orderMvh(std::span<MvhReference> run, const Aabb& root, const MvhParameters& parameters, MvhBuild build);

/// The codes of a tree over a run that is in the order of its leaves. Holds no reference to the run.
class MvhCoder {
  public:
    /// `root` is the box that the tree's root will have; it contains every reference's.
    MvhCoder(std::span<const MvhReference> run, const Aabb& root, uint32_t leafSize);

    /// A nibble for each inner node, one in each byte of `nibbles`, which has room for
    /// MvhShape::innerCount() of them. Each child gets the code that leaves it the least.
    void code(const MvhRule& rule, uint8_t* nibbles) const;
    /// The SAH cost that the boxes would have, times the root's area.
    double cost(const MvhRule& rule) const;

  private:
    template <class Visit>
    double descend(uint32_t node, const MvhBox& box, const MvhRule& rule, const Visit& visit) const;

    MvhShape shape_;
    Aabb root_;
    std::vector<Aabb> tight_;  // by node
};

}  // namespace bvhio
