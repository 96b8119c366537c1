// Tests every form with every builder's trees of awkward scenes: it must decode to a valid tree with the same
// leaves, whose boxes contain the boxes that it was made from.
#include "compress/forms.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "build/builders.h"
#include "build/median.h"
#include "common/test_scenes.h"
#include "scene/triangle_bounds.h"
#include "stats/hashes.h"
#include "tree/validate.h"

namespace bvhio {
namespace {

class FormsOfScene : public testing::TestWithParam<test::TestScene> {};

/// Returns for each entry of the leaf order the box of its leaf.
std::vector<Aabb> leafBoxes(const Bvh& bvh) {
    std::vector<Aabb> boxes(bvh.primitives.size(), Aabb::empty());
    for (const Node& node : bvh.nodes)
        for (uint32_t i = 0; i < node.primitiveCount; ++i) boxes[node.first + i] = node.bounds;
    return boxes;
}

/// Compares two trees node by node, from the roots down. A leaf may be divided, and entries may be in another
/// order.
void expectSameLeavesInLargerBoxes(const Bvh& bvh, const Bvh& decoded) {
    std::vector<std::pair<uint32_t, uint32_t>> waiting{{0, 0}};
    while (!waiting.empty()) {
        const auto [a, b] = waiting.back();
        waiting.pop_back();
        const Node& node = bvh.nodes[a];
        ASSERT_TRUE(decoded.nodes[b].bounds.contains(node.bounds)) << a;
        if (!node.isLeaf()) {
            ASSERT_FALSE(decoded.nodes[b].isLeaf());
            waiting.emplace_back(node.left(), decoded.nodes[b].left());
            waiting.emplace_back(node.right(), decoded.nodes[b].right());
            continue;
        }
        std::vector<uint32_t> entries, parts{b};
        while (!parts.empty()) {
            const Node& part = decoded.nodes[parts.back()];
            parts.pop_back();
            ASSERT_TRUE(part.bounds.contains(node.bounds)) << a;
            if (!part.isLeaf()) {
                parts.insert(parts.end(), {part.right(), part.left()});
            } else {
                const uint32_t* first = decoded.primitives.data() + part.first;
                entries.insert(entries.end(), first, first + part.primitiveCount);
            }
        }
        ASSERT_EQ(entries.size(), node.primitiveCount);
        ASSERT_TRUE(std::equal(entries.begin(), entries.end(), bvh.primitives.data() + node.first)) << a;
    }
}

TEST_P(FormsOfScene, decodeToValidTreesThatHoldTheOriginal) {
    const Scene scene = GetParam().make();
    for (const Builder& builder : builders())
        for (const uint32_t maxLeafSize : {1u, 4u, 13u}) {
            const Bvh bvh = builder.function(scene, {.costs = {}, .maxLeafSize = maxLeafSize});
            for (const FormChoice& form : forms()) {
                SCOPED_TRACE(testing::Message()
                             << builder.name << " leaves of " << maxLeafSize << ' ' << form.name);
                const EncodedBvh encoded = form.function(scene, bvh, {});
                EXPECT_EQ(formNameOf(encoded), form.name);
                const Bvh decoded = decode(encoded);
                for (const Finding& finding :
                     validate(decoded, uint32_t(scene.triangles.size()), boundsOfTriangles(scene)).findings)
                    ADD_FAILURE() << finding.message;
                ASSERT_TRUE(decoded.nodes[0].bounds.contains(bvh.nodes[0].bounds));
                // Encoding a decoded tree again does not enlarge boxes. (Parts of triangles are taken again
                // from leaves that grew.)
                const bool isSplit = bvh.primitives.size() != scene.triangles.size();
                const FormTraits& traits = form.function.traits;
                if (!isSplit || !traits.mergesLeaves || traits.buildsOwnTree) {
                    const EncodedBvh again = form.function(scene, decoded, {});
                    EXPECT_EQ(boundsHash(decode(again)), boundsHash(decoded));
                }
                EXPECT_EQ(traits.putsInClusters && decoded.nodes.size() > 2, !decoded.slots.empty());
                if (traits.isExact) {
                    EXPECT_EQ(boundsHash(decoded), boundsHash(bvh));
                }
                if (!traits.dividesLeaves && !traits.mergesLeaves) {
                    EXPECT_EQ(decoded.nodes.size(), bvh.nodes.size());
                }
                if (traits.mergesLeaves) continue;  // the tree is another, or its BLASes are
                if (!traits.keepsOrder) {
                    expectSameLeavesInLargerBoxes(bvh, decoded);
                    continue;
                }
                ASSERT_TRUE(std::equal(bvh.primitives.begin(), bvh.primitives.end(),
                                       decoded.primitives.begin(), decoded.primitives.end()));
                const std::vector<Aabb> boxes = leafBoxes(bvh), decodedBoxes = leafBoxes(decoded);
                for (size_t i = 0; i < boxes.size(); ++i)
                    ASSERT_TRUE(decodedBoxes[i].contains(boxes[i])) << i;
                if (decoded.nodes.size() == bvh.nodes.size()) {
                    EXPECT_EQ(topologyHash(decoded), topologyHash(bvh));
                }
            }
        }
}

// The tree that is given does not matter to a form that builds its own, and matters to all others.
TEST(Forms, buildTheirOwnTreeWhereTheySaySo) {
    const Scene scene = test::sceneOf(test::randomTriangles(600, 10, 1));
    const Bvh one = builders()[0].function(scene, {.costs = {}, .maxLeafSize = 1});
    const Bvh other = buildMedian(scene, {.costs = {}, .maxLeafSize = 13});
    for (const FormChoice& form : forms()) {
        const Bvh a = decode(form.function(scene, one, {})), b = decode(form.function(scene, other, {}));
        EXPECT_EQ(form.function.traits.buildsOwnTree,
                  topologyHash(a) == topologyHash(b) && boundsHash(a) == boundsHash(b))
            << form.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Awkward, FormsOfScene,
                         testing::ValuesIn(test::testScenes().begin(), test::testScenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace bvhio
