#include "tree/slot_map.h"

#include <gtest/gtest.h>

#include "unit/relayout/small_tree.h"

namespace bvhio {
namespace {

constexpr uint32_t kGlue = SlotMap::kGlue, kEmpty = SlotMap::kEmpty;

/// Validates slots of a tree with four pairs: pair 0 has the root's children, pairs 1 and 2 are below it, and
/// pair 3 is below pair 1.
std::string faultOf(std::vector<uint32_t> words, uint32_t pointerBits = 2, uint32_t lineSlots = 2) {
    Bvh bvh = test::treeOfPairs({{0, 2}, {2, 4}, {3, 6}, {4, 8}});
    bvh.slots = {pointerBits, lineSlots, std::move(words)};
    return validateSlots(bvh);
}

// Code that stores a tree by its map relies on each of these rules.
TEST(SlotMap, isOfATreeWhoseRulesItKeeps) {
    EXPECT_EQ(faultOf({0, 1, 2, 3}), "");
    EXPECT_EQ(faultOf({0, 1, 2, kGlue | 3, 3}), "");
    EXPECT_EQ(faultOf({0, kGlue | 1, 2, kEmpty, 1, 3}), "");
    EXPECT_EQ(faultOf({0, 2, kGlue | 1, kEmpty, 1, kGlue | 3, 3}), "");
}

TEST(SlotMap, isOfNoTreeWhoseRulesItBreaks) {
    EXPECT_NE(faultOf({0, 1, 2, 3}, 1), "") << "bits";
    EXPECT_NE(faultOf({0, 1, 2, 3}, 11), "") << "bits";
    EXPECT_NE(faultOf({0, 1, 2, 3}, 2, 3), "") << "line";
    EXPECT_NE(faultOf({0, 1, 2, 3}, 2, 128), "") << "line";
    EXPECT_NE(faultOf({0, 1, 2, 4}), "") << "no such pair";
    EXPECT_NE(faultOf({0, 1, 2}), "") << "a pair is missing";
    EXPECT_NE(faultOf({0, 1, 2, 3, 3}), "") << "a pair twice";
    EXPECT_NE(faultOf({0, kGlue | 1, kGlue | 1, 2, 1, 3}), "") << "glue twice";
    EXPECT_NE(faultOf({0, 1, 2, kEmpty, 3}), "") << "out of reach";
    EXPECT_NE(faultOf({kEmpty, 0, 1, 2, 3}, 3), "") << "the root's is not first";
    EXPECT_NE(faultOf({0, kGlue | 0, 1, 2, 3}, 3), "") << "glue to the root's";
    EXPECT_NE(faultOf({0, kGlue | 1, 2, 1, 3}), "") << "a cluster starts within a line";
    EXPECT_NE(faultOf({0, 1, 3, 2, kGlue | 2}, 3), "") << "glue behind its record";
    EXPECT_NE(faultOf({0, 2, 3, 1}), "") << "a child before its parent";
    EXPECT_NE(faultOf({0, kGlue | 1, 2, kGlue | 3, 1, kEmpty, 3}), "")
        << "glue in another cluster than the parent";
    EXPECT_NE(faultOf({0, kGlue | 1, 3, kEmpty, 1, 2}), "") << "records in another cluster than the parent";
    EXPECT_NE(faultOf({0, kGlue | 1, 2, 3, 1}, 3, 1), "") << "a child in the cluster before";
}

TEST(SlotMap, countsWhatSlotsAreSpentOn) {
    const SlotStats stats = statsOf({2, 2, std::vector<uint32_t>{0, kGlue | 1, 2, kEmpty, 1, 3}});
    EXPECT_EQ(stats.slots, 6u);
    EXPECT_EQ(stats.records, 4u);
    EXPECT_EQ(stats.clusters, 2u);
    EXPECT_EQ(stats.glueShare(), 0.25);
    EXPECT_EQ(stats.paddingShare(), 1.0 / 6);
    EXPECT_EQ(stats.fill(2), 5.0 / 8);
}

}  // namespace
}  // namespace bvhio
