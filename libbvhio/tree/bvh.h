// The canonical binary BVH that every pass sees, and its invariants.
#pragma once

#include <cstdint>

#include "core/aabb.h"
#include "core/shared_array.h"
#include "tree/slot_map.h"

namespace bvhio {

/// One node: 32 bytes, plain data, stored as is in files. Two siblings fill one 64-byte cache line.
struct Node {
    Aabb bounds;
    /// Inner node: index of the left child; the right child is next. Leaf: index into Bvh::primitives.
    uint32_t first;
    uint32_t primitiveCount;  // 0 for an inner node

    constexpr bool isLeaf() const { return primitiveCount != 0; }
    constexpr uint32_t left() const { return first; }
    constexpr uint32_t right() const { return first + 1; }
};
static_assert(sizeof(Node) == 32);

/// A binary bounding volume hierarchy over the triangles of a Scene. Its invariants, which `validate` checks
/// and which every pass may rely on and must keep:
///
/// 1. nodes[0] is the root. nodes[1] is unused and all zero, so that every sibling pair starts at an even
///    index and, with the array 64-byte aligned, shares one cache line. A tree of one leaf has the root and
///    the unused slot: nodes.size() is even.
/// 2. Every other slot is the child of exactly one inner node. A node's children come after it (first > own
///    index), so a reverse sweep over the array is a bottom-up pass, and there are no cycles.
/// 3. A leaf owns primitives[first, first + primitiveCount), 1 to kMaxLeafSize entries; the ranges of all
///    leaves cover `primitives` without overlap. An entry is an index into Scene::triangles. Each triangle is
///    in at least one leaf, and in exactly one unless spatial splits duplicated it. With duplicates,
///    primitives.size(), the number of references, exceeds the triangle count.
/// 4. Boxes are finite, and min <= max on each axis. An inner box contains its children's boxes. A leaf's box
///    contains each of its triangles, or, for a duplicated triangle, a part of it such that all of that
///    triangle's leaves together contain it.
/// 5. The depth (edges from the root to the deepest leaf) is at most kMaxDepth, so that a stack of fixed size
///    is enough for traversal.
///
/// An empty scene has no BVH: importers refuse it.
struct Bvh {
    SharedArray<Node> nodes;
    SharedArray<uint32_t> primitives;
    /// Maps the pairs of siblings, in this order, to clusters, if a layout made clusters. A pass that changes
    /// the order or the topology drops the map.
    SlotMap slots{};

    /// Returns the number of nodes, without the unused slot.
    size_t nodeCount() const { return nodes.size() - 1; }
};

inline constexpr uint32_t kMaxDepth = 96;
inline constexpr uint32_t kMaxLeafSize = 65535;

}  // namespace bvhio
