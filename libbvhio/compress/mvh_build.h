// Builds the trees of the mvh form: the primitives that go left, and the codes of nodes.
#pragma once

#include <span>
#include <vector>

#include "compress/mvh_tree.h"

namespace bvhio {

/// A primitive and its box, which builders move around: two vectors of four lanes.
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

/// Returns the references of all triangles, in order.
std::vector<MvhReference> mvhReferences(const Scene& scene);

/// Sorts a run of at least one reference into the order of a tree's leaves. `root` is the box of the tree's
/// root, and contains every reference's box. The paper's build halves by centroid along the longest axis of
/// the node's reconstructed box. The best build tries all axes, by centroid, low side and high side, and
/// keeps the split with the least count * (reconstructed area + area after one more cut + 2 * tight area).
/// Deterministic, parallel for long runs, and fast: about 1 us per reference.
void orderMvh(std::span<MvhReference> run, const Aabb& root, const MvhParameters& parameters, MvhBuild build);

/// Computes the codes of a tree over a run that is in the order of its leaves. Does not refer to the run.
class MvhCoder {
  public:
    /// `root` is the box of the tree's root, and contains every reference's box.
    MvhCoder(std::span<const MvhReference> run, const Aabb& root, uint32_t leafSize);

    /// Writes a nibble for each inner node, one in each byte of `nibbles`, which has space for
    /// MvhShape::innerCount() bytes. Each child gets the code that gives the smallest box.
    void code(const MvhRule& rule, uint8_t* nibbles) const;
    /// Returns the SAH cost of the boxes, times the root's area.
    double cost(const MvhRule& rule) const;

  private:
    template <class Visit>
    double descend(uint32_t node, const MvhBox& box, const MvhRule& rule, const Visit& visit) const;

    MvhShape shape_;
    Aabb root_;
    std::vector<Aabb> tight_;  // by node
};

}  // namespace bvhio
