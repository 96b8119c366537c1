// The invariants of tree/bvh.h, checked by a walk that shares no code with tree/validate.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "scene/scene.h"
#include "tree/bvh.h"

namespace bvhio::test {

/// Walks the tree and checks the invariants of tree/bvh.h.
inline void expectValid(const Scene& scene, const Bvh& bvh, uint32_t maxLeafSize) {
    ASSERT_GE(bvh.nodes.size(), 2u);
    ASSERT_EQ(bvh.nodes.size() % 2, 0u);
    const Node unused{{{0, 0, 0}, {0, 0, 0}}, 0, 0};
    EXPECT_EQ(std::memcmp(&bvh.nodes[1], &unused, sizeof unused), 0);

    std::vector<int> parents(bvh.nodes.size(), 0), entries(bvh.primitives.size(), 0);
    std::vector<uint32_t> depths(bvh.nodes.size(), 0);
    std::vector<bool> held(scene.triangles.size(), false);
    for (uint32_t i = 0; i < bvh.nodes.size(); ++i) {
        if (i == 1) continue;
        const Node& node = bvh.nodes[i];
        ASSERT_TRUE(isFinite(node.bounds.min) && isFinite(node.bounds.max)) << "node " << i;
        ASSERT_FALSE(node.bounds.isEmpty()) << "node " << i;
        for (int axis = 0; axis < 3; ++axis)
            ASSERT_FALSE(node.bounds.min[axis] == 0 && std::signbit(node.bounds.min[axis])) << "node " << i;
        ASSERT_LE(depths[i], kMaxDepth);
        if (node.isLeaf()) {
            ASSERT_LE(node.primitiveCount, maxLeafSize);
            ASSERT_LE(uint64_t(node.first) + node.primitiveCount, bvh.primitives.size());
            for (uint32_t k = node.first; k < node.first + node.primitiveCount; ++k) {
                ++entries[k];
                ASSERT_LT(bvh.primitives[k], scene.triangles.size());
                held[bvh.primitives[k]] = true;
                if (bvh.primitives.size() == scene.triangles.size()) {
                    ASSERT_TRUE(node.bounds.contains(bounds(scene.triangle(bvh.primitives[k]))))
                        << "node " << i;
                }
            }
        } else {
            ASSERT_GT(node.first, i);
            ASSERT_EQ(node.first % 2, 0u);
            ASSERT_LT(node.right(), bvh.nodes.size());
            for (const uint32_t child : {node.left(), node.right()}) {
                ++parents[child];
                depths[child] = depths[i] + 1;
                ASSERT_TRUE(node.bounds.contains(bvh.nodes[child].bounds)) << "node " << i;
            }
        }
    }
    for (uint32_t i = 2; i < bvh.nodes.size(); ++i) ASSERT_EQ(parents[i], 1) << "node " << i;
    for (uint32_t k = 0; k < entries.size(); ++k) ASSERT_EQ(entries[k], 1) << "entry " << k;
    for (uint32_t t = 0; t < held.size(); ++t) ASSERT_TRUE(held[t]) << "triangle " << t;
}

inline bool sameBytes(const Bvh& a, const Bvh& b) {
    return a.nodes.size() == b.nodes.size() && a.primitives.size() == b.primitives.size() &&
           std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(Node)) == 0 &&
           std::memcmp(a.primitives.data(), b.primitives.data(), a.primitives.size() * sizeof(uint32_t)) == 0;
}

}  // namespace bvhio::test
