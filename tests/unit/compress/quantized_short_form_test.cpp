#include "compress/quantized_short_form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "build/builders.h"
#include "common/expect_valid.h"
#include "common/test_scenes.h"
#include "compress/quantized_form.h"
#include "core/error.h"
#include "stats/hashes.h"
#include "trace/trace.h"
#include "tree/clusters.h"
#include "unit/relayout/small_tree.h"

namespace bvhio {
namespace {

QuantizedShortForm encode(const Bvh& bvh, uint32_t pointerBits = 8, uint32_t lineSize = 64) {
    return QuantizedShortForm::encode({}, bvh, {.pointerBits = pointerBits, .lineSize = lineSize});
}

std::vector<uint32_t> firstEntries(uint32_t count) {
    std::vector<uint32_t> entries(count);
    for (uint32_t i = 0; i < count; ++i) entries[i] = i;
    return entries;
}

TEST(QuantizedShortForm, storesInsetsOwnersAndReferences) {
    AlignedVector<Node> nodes{{{{0, 0, 0}, {64, 16, 1}}, 2, 0},
                              {},
                              {{{0, 0.5f, 0}, {24.5f, 16, 1}}, 0, 3},
                              {{{25.5f, 0, 0}, {64, 16, 1}}, 3, 6}};
    const QuantizedShortForm form = encode({std::move(nodes), firstEntries(9)});
    ASSERT_EQ(form.slots().size(), 1u);
    const ShortRecord& record = form.slots()[0];
    EXPECT_FALSE(record.isGlue());
    const uint32_t insets[] = {25, 2, 0, 39, 0, 0};
    for (uint32_t side = 0; side < 6; ++side) {
        EXPECT_EQ(record.inset(side), insets[side]) << side;
        EXPECT_EQ(record.ownerIsRight(side), side == 0) << side;
    }
    EXPECT_EQ(record.reference(0), 256u);
    EXPECT_EQ(record.reference(1), 259u);
    ASSERT_EQ(form.lastEntries().size(), 2u);
    EXPECT_EQ(form.lastEntries()[0], 1u << 2 | 1u << 8);
    const Bvh decoded = form.decode();
    EXPECT_EQ(decoded.nodes[2].bounds, (Aabb{{0, 0.5f, 0}, {25, 16, 1}}));
    EXPECT_EQ(decoded.nodes[3].bounds, (Aabb{{25, 0, 0}, {64, 16, 1}}));
    EXPECT_EQ(decoded.nodes[3].primitiveCount, 6u);
}

TEST(QuantizedShortForm, keepsTheNumbersOfGlueApart) {
    for (const uint32_t line : {1u, (1u << 21) - 1, 1u << 21, (1u << 26) - 1})
        for (const uint32_t entry : {0u, 1u, (1u << 27) - 1}) {
            const ShortRecord glue = ShortRecord::glue(line, entry);
            EXPECT_TRUE(glue.isGlue());
            EXPECT_FALSE(glue.isEmpty());
            EXPECT_EQ(glue.line(), line);
            EXPECT_EQ(glue.firstEntry(), entry);
        }
}

TEST(QuantizedShortForm, takesAnEighthOfFullBoxesAndLittleMore) {
    const Scene scene = test::sphereScene(80, 40);
    const Bvh bvh = builders()[0].function(scene, {.costs = {}, .maxLeafSize = 1});
    for (const uint32_t pointerBits : {8u, 10u})
        EXPECT_LE(double(encode(bvh, pointerBits).nodeBytes()),
                  0.14 * double(bvh.nodes.size() - 2) * sizeof(Node));
    EXPECT_TRUE(encode(bvh).lastEntries().empty());
}

TEST(QuantizedShortForm, keepsClustersThatFitAndMakesOthersAnew) {
    const Scene scene = test::sphereScene(30, 20);
    Bvh bvh = builders()[0].function(scene, {.costs = {}, .maxLeafSize = 2});
    bvh.slots = makeClusters(bvh, {6, 4, ClusterMethod::paper});
    const QuantizedShortForm kept = encode(bvh, 8, 64);
    EXPECT_EQ(kept.pointerBits(), 6u);
    EXPECT_EQ(kept.lineSlots(), 4u);
    EXPECT_EQ(kept.slots().size(), bvh.slots.words.size());
    const Bvh decoded = kept.decode();
    EXPECT_EQ(validateSlots(decoded), "");
    EXPECT_EQ(topologyHash(decoded), topologyHash(bvh));
    const QuantizedShortForm again = encode(decoded);
    EXPECT_TRUE(test::sameBytes(again.decode(), decoded));
    ASSERT_EQ(again.slots().size(), kept.slots().size());
    EXPECT_EQ(std::memcmp(again.slots().data(), kept.slots().data(), kept.slots().size() * 8), 0);

    bvh.slots.words = std::vector<uint32_t>{0, 1, 2};
    EXPECT_EQ(topologyHash(encode(bvh).decode()), topologyHash(bvh));
}

TEST(QuantizedShortForm, holdsLeavesOfUpTo32AndDividesLargerOnes) {
    const Aabb box{{0, 0, 0}, {1, 1, 1}};
    for (const uint32_t size : {1u, 31u, 32u}) {
        const QuantizedShortForm form = encode({AlignedVector<Node>{{box, 0, size}, {}}, firstEntries(size)});
        EXPECT_TRUE(form.slots().empty());
        EXPECT_EQ(form.decode().nodes[0].primitiveCount, size);
        EXPECT_EQ(form.countFrom(form.firstEntryOf(0, form.firstLeaf())), size);
    }
    for (const uint32_t size : {33u, 1000u, kMaxLeafSize}) {
        const QuantizedShortForm form = encode({AlignedVector<Node>{{box, 0, size}, {}}, firstEntries(size)});
        const Bvh decoded = form.decode();
        uint32_t total = 0;
        for (const Node& node : decoded.nodes) {
            EXPECT_LE(node.primitiveCount, 32u);
            total += node.primitiveCount;
        }
        EXPECT_EQ(total, size);
    }
}

// A slot map for the tree with its large leaves does not fit the tree with divided leaves.
TEST(QuantizedShortForm, makesClustersAnewWhereLeavesAreDivided) {
    Bvh bvh = test::treeOfPairs({{0, 2}});
    bvh.nodes =
        AlignedVector<Node>{bvh.nodes[0], {}, {bvh.nodes[0].bounds, 0, 100}, {bvh.nodes[0].bounds, 100, 1}};
    bvh.primitives = firstEntries(101);
    bvh.slots = {8, 8, std::vector<uint32_t>{0}};
    EXPECT_EQ(encode(bvh).decode().nodes.size(), 2u + 2 * 4);
}

TEST(QuantizedShortForm, refusesMoreReferencesThanGlueCanName) {
    Bvh bvh;
    bvh.nodes = AlignedVector<Node>(2);
    const uint32_t none = 0;
    bvh.primitives = SharedArray<uint32_t>(nullptr, {&none, ShortRecord::kMaxReferences + 1});
    try {
        QuantizedShortForm::encode({}, bvh, {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    }
}

}  // namespace
}  // namespace bvhio
