// The ssh form: the Single Slab Hierarchy of M. Eisemann, C. Woizischke and M. Magnor, "Ray Tracing with the
// Single-Slab Hierarchy", VMV 2008. A node of 8 bytes holds one plane. It inherits its parent's box, and the
// plane replaces the side of this box whose move inwards shrinks it most.
//
// Departures: both children's planes are tested before the push (the paper tests a node's own plane after it
// is popped), siblings are adjacent, and leaves store their number of triangles (the paper pads all leaves to
// one size).
#pragma once

#include <array>

#include "compress/forest.h"
#include "compress/form_concept.h"
#include "core/buffer.h"

namespace bvhio {

/// 8 bytes, plain data, stored as is in files (format-spec/ssh.md).
struct SshNode {
    float plane;
    uint32_t word;

    static constexpr uint32_t kLeaf = 3;
    static constexpr uint32_t kMaxLeafSize = 4;
    static constexpr uint32_t kMaxReferences = 1u << 25;

    /// Returns which of {min.x, min.y, min.z, max.x, max.y, max.z} the plane is.
    constexpr uint32_t side() const { return word & 7; }
    constexpr bool isLeaf() const { return splitAxis() == kLeaf; }
    /// Returns an inner node's axis along which its left child lies below the right one, or 3 for a leaf.
    constexpr uint32_t splitAxis() const { return word >> 3 & 3; }
    /// Returns an inner node's left child. The right one is next to it.
    constexpr uint32_t left() const { return word >> 5 << 1; }
    constexpr uint32_t firstPrimitive() const { return word >> 5 & (kMaxReferences - 1); }
    constexpr uint32_t primitiveCount() const { return (word >> 30) + 1; }

    static constexpr SshNode inner(float plane, uint32_t side, uint32_t splitAxis, uint32_t left) {
        return {plane, side | splitAxis << 3 | left >> 1 << 5};
    }
    static constexpr SshNode leaf(float plane, uint32_t side, uint32_t first, uint32_t count) {
        return {plane, side | kLeaf << 3 | first << 5 | (count - 1) << 30};
    }
};
static_assert(sizeof(SshNode) == 8);

class SshForm {
  public:
    static constexpr std::string_view kName = "ssh";
    static constexpr std::string_view kSummary = "8-byte nodes of one plane each (Single Slab Hierarchy)";
    static constexpr FormTraits kTraits{.keepsOrder = true, .dividesLeaves = true};
    static constexpr std::array<std::string_view, 1> kCandidates{""};
    struct Options {
        bool operator==(const Options&) const = default;
    };
    static std::span<const FormOption<Options>> optionTable() { return {}; }

    /// `nodes` as in format-spec/ssh.md; slot 1 is unused.
    SshForm(const Aabb& bounds, SharedArray<SshNode> nodes, SharedArray<uint32_t> primitives)
        : bounds_(bounds), nodes_(std::move(nodes)), primitives_(std::move(primitives)) {}

    /// O(n). Leaves of more than 4 triangles are halved. Throws Error{unsupported} above 2^25 references.
    static SshForm encode(const Scene& scene, const Bvh& bvh, const Options& options);

    Bvh decode() const;
    const Aabb& bounds() const { return bounds_; }
    const SharedArray<SshNode>& nodes() const { return nodes_; }
    const SharedArray<uint32_t>& primitives() const { return primitives_; }
    Options options() const { return {}; }
    size_t nodeBytes() const { return nodes_.size() * sizeof(SshNode); }

    /// Many trees: the nodes below their roots, and the words of the roots. The roots' boxes are not stored.
    struct Trees {
        SharedArray<uint32_t> roots;
        SharedArray<SshNode> nodes;
    };
    /// Encodes many trees, like `encode`. The roots keep their boxes, which are `boxes`.
    static Trees encodeTrees(const Forest& forest, std::span<const Aabb> boxes, size_t references);
    static Forest decodeTrees(const Trees& trees, std::span<const Aabb> boxes);

  private:
    Aabb bounds_;
    SharedArray<SshNode> nodes_;
    SharedArray<uint32_t> primitives_;
};
static_assert(Form<SshForm>);

}  // namespace bvhio
