#include "compress/ssh_form.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "build/builders.h"
#include "common/test_scenes.h"
#include "compress/two_level_form.h"
#include "core/error.h"
#include "tree/sah_cost.h"

namespace bvhio {
namespace {

/// A root over leaves [0, 1] x [0, 1] x [0, 8] and [2, 4] x [0, 1] x [0, 8].
Bvh twoBoxes() {
    AlignedVector<Node> nodes{
        {{{0, 0, 0}, {4, 1, 8}}, 2, 0}, {}, {{{2, 0, 0}, {4, 1, 8}}, 0, 1}, {{{0, 0, 0}, {1, 1, 8}}, 1, 1}};
    return {std::move(nodes), std::vector<uint32_t>{0, 1}};
}

// Each child has the one plane that shrinks its box most. The lower child comes first.
TEST(SshForm, keepsThePlaneThatSavesMost) {
    const SshForm form = SshForm::encode({}, twoBoxes(), {});
    ASSERT_EQ(form.nodes().size(), 4u);
    const SshNode &left = form.nodes()[2], &right = form.nodes()[3];
    EXPECT_EQ(form.nodes()[0].splitAxis(), 0u);
    EXPECT_EQ(form.nodes()[0].left(), 2u);
    EXPECT_EQ(left.side(), 3u);
    EXPECT_EQ(left.plane, 1);
    EXPECT_TRUE(left.isLeaf());
    EXPECT_EQ(left.firstPrimitive(), 1u);
    EXPECT_EQ(left.primitiveCount(), 1u);
    EXPECT_EQ(right.side(), 0u);
    EXPECT_EQ(right.plane, 2);
    EXPECT_EQ(right.firstPrimitive(), 0u);
}

// A box that differs from its parent's on several sides stores one of them. Deeper nodes store the others.
TEST(SshForm, inheritsTheOtherSides) {
    AlignedVector<Node> nodes{
        {{{0, 0, 0}, {4, 4, 4}}, 2, 0}, {}, {{{0, 0, 0}, {1, 2, 4}}, 0, 1}, {{{3, 0, 0}, {4, 4, 4}}, 1, 1}};
    const SshForm form = SshForm::encode({}, {std::move(nodes), std::vector<uint32_t>{0, 1}}, {});
    EXPECT_EQ(form.decode().nodes[2].bounds, (Aabb{{0, 0, 0}, {1, 4, 4}}));
}

TEST(SshForm, takesAQuarterOfTheAabbFormsBytes) {
    const Scene scene = test::sphereScene(60, 30);
    const Bvh bvh = builders()[0].function(scene, {});
    const SshForm form = SshForm::encode(scene, bvh, {});
    EXPECT_EQ(form.nodeBytes() * 4, bvh.nodes.size() * sizeof(Node));
}

TEST(SshForm, dividesLeavesThatAreTooLarge) {
    const Scene scene = test::sceneOf(test::randomTriangles(500, 1, 0.1f));
    const Bvh bvh = builders()[0].function(scene, {.costs = {1e6f, 1}, .maxLeafSize = kMaxLeafSize});
    ASSERT_EQ(bvh.nodes.size(), 2u);
    const Bvh decoded = SshForm::encode(scene, bvh, {}).decode();
    uint32_t largest = 0, total = 0;
    for (const Node& node : decoded.nodes) {
        largest = std::max(largest, node.primitiveCount);
        total += node.primitiveCount;
    }
    EXPECT_EQ(largest, SshNode::kMaxLeafSize);
    EXPECT_EQ(total, 500u);
}

// A chain as deep as a tree may be, whose last leaf has `last` triangles.
Bvh deepChain(uint32_t last) {
    const Aabb box{{0, 0, 0}, {1, 1, 1}};
    AlignedVector<Node> nodes{{box, 2, 0}, {}};
    for (uint32_t depth = 1; depth <= kMaxDepth; ++depth) {
        nodes.push_back({box, depth - 1, 1});
        nodes.push_back({box, uint32_t(nodes.size()) + 1, 0});
    }
    nodes.back() = {box, kMaxDepth, last};
    return {std::move(nodes), std::vector<uint32_t>(kMaxDepth + last)};
}

// Halves of a leaf at the greatest depth would be deeper than any traversal has room for.
TEST(SshForm, refusesLargeLeavesThatLieTooDeepToBeDivided) {
    EXPECT_THROW(SshForm::encode({}, deepChain(SshNode::kMaxLeafSize + 1), {}), Error);
    const Bvh fits = deepChain(SshNode::kMaxLeafSize);
    EXPECT_EQ(SshForm::encode({}, fits, {}).decode().nodes.size(), fits.nodes.size());
    const TwoLevelForm::Options options{.tlasForm = TlasForm::aabb, .blasForm = BlasForm::ssh};
    EXPECT_THROW(TwoLevelForm::encode({}, deepChain(SshNode::kMaxLeafSize + 1), options), Error);
    EXPECT_EQ(TwoLevelForm::encode({}, fits, options).decode().nodes.size(), fits.nodes.size());
}

TEST(SshForm, refusesMoreReferencesThanItsWordsCanName) {
    Bvh bvh = twoBoxes();
    bvh.primitives = std::vector<uint32_t>(SshNode::kMaxReferences + 1);
    try {
        SshForm::encode({}, bvh, {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    }
}

}  // namespace
}  // namespace bvhio
