#include "compress/quantized_form.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "build/builders.h"
#include "common/test_scenes.h"
#include "core/error.h"

namespace bvhio {
namespace {

QuantizedForm encode(AlignedVector<Node> nodes, uint32_t primitives, uint32_t bits = 8) {
    std::vector<uint32_t> order(primitives);
    for (uint32_t i = 0; i < primitives; ++i) order[i] = i;
    return QuantizedForm::encode({}, {std::move(nodes), std::move(order)}, {.bits = bits});
}

// An inset of 0 is the parent's plane. Other planes are their child's, rounded outwards.
TEST(QuantizedForm, storesInsetsOfTheChildThatHasThePlane) {
    const QuantizedForm form = encode({{{{0, 0, 0}, {256, 16, 1}}, 2, 0},
                                       {},
                                       {{{0, 0.5f, 0}, {99.5f, 16, 1}}, 0, 3},
                                       {{{100.5f, 0, 0}, {256, 16, 1}}, 3, 6}},
                                      9);
    ASSERT_EQ(form.records().size(), 1u);
    const QuantizedRecord& record = form.records()[0];
    const uint32_t insets[] = {100, 8, 0, 156, 0, 0};
    for (uint32_t side = 0; side < 6; ++side) {
        EXPECT_EQ(record.inset(side), insets[side]) << side;
        EXPECT_EQ(record.ownerIsRight(side), side == 0) << side;
    }
    EXPECT_TRUE(QuantizedRecord::isLeaf(record.children[1]));
    EXPECT_EQ(QuantizedRecord::firstPrimitive(record.children[1]), 3u);
    EXPECT_EQ(QuantizedRecord::primitiveCount(record.children[1], record.highBits(1)), 6u);
    const Bvh decoded = form.decode();
    EXPECT_EQ(decoded.nodes[2].bounds, (Aabb{{0, 0.5f, 0}, {100, 16, 1}}));
    EXPECT_EQ(decoded.nodes[3].bounds, (Aabb{{100, 0, 0}, {256, 16, 1}}));
}

// If rounding made the parent larger than both children, the child that lies further inside has the plane.
TEST(QuantizedForm, givesThePlaneToTheChildFurtherInside) {
    const QuantizedForm form = encode({{{{0, 0, 0}, {256, 1, 1}}, 2, 0},
                                       {},
                                       {{{7, 0, 0}, {200, 1, 1}}, 0, 1},
                                       {{{9, 0, 0}, {256, 1, 1}}, 1, 1}},
                                      2);
    EXPECT_EQ(form.records()[0].inset(0), 9u);
    EXPECT_TRUE(form.records()[0].ownerIsRight(0));
    EXPECT_EQ(form.decode().nodes[2].bounds.min.x, 0);
}

TEST(QuantizedForm, roundsCoarserWithFewerBits) {
    AlignedVector<Node> nodes{{{{0, 0, 0}, {64, 1, 1}}, 2, 0},
                              {},
                              {{{0, 0, 0}, {64, 1, 1}}, 0, 1},
                              {{{3.7f, 0, 0}, {64, 1, 1}}, 1, 1}};
    EXPECT_EQ(encode(nodes, 2, 8).decode().nodes[3].bounds.min.x, 3.5f);
    EXPECT_EQ(encode(nodes, 2, 5).decode().nodes[3].bounds.min.x, 2);
}

TEST(QuantizedForm, takesAQuarterOfTheAabbFormsBytes) {
    const Scene scene = test::sphereScene(60, 30);
    const Bvh bvh = builders()[0].function(scene, {});
    const QuantizedForm form = QuantizedForm::encode(scene, bvh, {});
    EXPECT_EQ(form.nodeBytes() * 4, (bvh.nodes.size() - 2) * sizeof(Node));
}

TEST(QuantizedForm, holdsLeavesOfUpTo128AndDividesLargerOnes) {
    const Scene scene = test::sceneOf(test::randomTriangles(500, 1, 0.1f));
    const Bvh bvh = builders()[0].function(scene, {.costs = {1e6f, 1}, .maxLeafSize = kMaxLeafSize});
    ASSERT_EQ(bvh.nodes.size(), 2u);
    const QuantizedForm form = QuantizedForm::encode(scene, bvh, {});
    const Bvh decoded = form.decode();
    uint32_t leaves = 0, total = 0;
    for (const Node& node : decoded.nodes) {
        leaves += node.isLeaf();
        total += node.primitiveCount;
    }
    EXPECT_EQ(leaves, 4u);  // of 125 each
    EXPECT_EQ(total, 500u);
    EXPECT_EQ(QuantizedForm::encode(scene, decoded, {}).decode().nodes.size(), decoded.nodes.size());

    const Aabb box{{0, 0, 0}, {1, 1, 1}};
    const QuantizedForm oneLeaf = encode({{box, 0, 128}, {}}, 128);
    EXPECT_TRUE(oneLeaf.records().empty());
    EXPECT_EQ(oneLeaf.decode().nodes[0].primitiveCount, 128u);
}

TEST(QuantizedForm, refusesMoreReferencesThanItsWordsCanName) {
    Bvh bvh;
    bvh.nodes = AlignedVector<Node>(2);
    const uint32_t none = 0;
    bvh.primitives = SharedArray<uint32_t>(nullptr, {&none, QuantizedRecord::kMaxReferences + 1});
    try {
        QuantizedForm::encode({}, bvh, {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    }
}

// A leaf at the greatest depth has no room for another level.
TEST(QuantizedForm, refusesToDivideLeavesThatLieTooDeep) {
    const Aabb box{{0, 0, 0}, {1, 1, 1}};
    AlignedVector<Node> nodes{{box, 2, 0}, {}};
    for (uint32_t depth = 1; depth <= kMaxDepth; ++depth) {
        nodes.push_back({box, depth - 1, 1});
        nodes.push_back({box, uint32_t(nodes.size()) + 1, 0});
    }
    nodes.back() = {box, kMaxDepth, 129};
    EXPECT_THROW(encode(nodes, kMaxDepth + 129), Error);
    nodes.back().primitiveCount = 128;
    EXPECT_EQ(encode(nodes, kMaxDepth + 128).decode().nodes.size(), nodes.size());
}

}  // namespace
}  // namespace bvhio
