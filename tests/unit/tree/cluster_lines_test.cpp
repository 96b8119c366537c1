#include "tree/cluster_lines.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/random_tree.h"

namespace bvhio {
namespace {

constexpr uint32_t kAnySlots = 1u << 20;

/// Returns a random tree of items. Children weigh no more than their parents.
std::vector<TreeItem> randomItems(uint32_t count, Random& random) {
    std::vector<TreeItem> items(count);
    items[0].weight = 100;
    for (uint32_t i = 1; i < count; ++i) {
        const uint32_t parent = test::attachAtRandom(items, i, random);
        items[i].weight = items[parent].weight * double(random.below(5)) / 4;
    }
    return items;
}

/// Returns the expected number of steps from one line to another.
double stepsBetween(const std::vector<TreeItem>& items, const ClusterLines& lines) {
    std::vector<size_t> lineOf(items.size());
    for (size_t line = 0; line < lines.size(); ++line)
        for (const uint32_t item : lines[line]) lineOf[item] = line;
    double steps = 0;
    for (size_t i = 0; i < items.size(); ++i)
        for (const uint32_t child : items[i].children)
            if (child != TreeItem::kNone && lineOf[child] != lineOf[i]) steps += items[child].weight;
    return steps;
}

void expectWhole(const std::vector<TreeItem>& items, const ClusterLines& lines, uint32_t lineSlots) {
    std::vector<uint32_t> place(items.size(), 0);
    uint32_t next = 0;
    for (const std::vector<uint32_t>& line : lines) {
        EXPECT_LE(line.size(), lineSlots);
        EXPECT_FALSE(line.empty());
        for (const uint32_t item : line) {
            ASSERT_EQ(place[item], 0u) << "twice";
            place[item] = ++next;
        }
    }
    EXPECT_EQ(next, items.size());
    for (size_t i = 0; i < items.size(); ++i)
        for (const uint32_t child : items[i].children)
            if (child != TreeItem::kNone) {
                EXPECT_LT(place[i], place[child]) << "before its parent";
            }
}

TEST(ClusterLines, holdEveryItemBehindItsParent) {
    Random random(1);
    for (const uint32_t lineSlots : {1u, 2u, 8u, 64u})
        for (const uint32_t count : {1u, 2u, 7u, 100u}) {
            const std::vector<TreeItem> items = randomItems(count, random);
            expectWhole(items, packLines(items, lineSlots, kAnySlots), lineSlots);
            expectWhole(items, growLines(items, lineSlots), lineSlots);
        }
}

// Few lines may end short: merging must keep padding low.
TEST(ClusterLines, areNearlyFull) {
    Random random(2);
    const std::vector<TreeItem> items = randomItems(1000, random);
    EXPECT_LE(packLines(items, 8, kAnySlots).size(), 1000 / 8 + 8);
    EXPECT_LE(growLines(items, 8).size(), 1000 / 8 + 8);
}

// Lines with more padding than their cluster has free slots would push later lines out of reach of pointers,
// or off the starts of lines.
TEST(ClusterLines, keepToTheSlotsThereAre) {
    Random random(3);
    bool wasTight = false;
    for (int round = 0; round < 20; ++round) {
        const std::vector<TreeItem> items = randomItems(200 + random.below(57), random);
        const size_t free = packLines(items, 8, kAnySlots).size() * 8;
        for (const uint32_t maxSlots : {uint32_t(items.size()), uint32_t(items.size()) + 3, 256u}) {
            const ClusterLines lines = packLines(items, 8, maxSlots);
            expectWhole(items, lines, 8);
            EXPECT_LE((lines.size() - 1) * 8 + lines.back().size(), maxSlots) << round;
            wasTight |= free > maxSlots;
        }
    }
    EXPECT_TRUE(wasTight);
}

// Compares with every way to cut a small tree into lines.
TEST(ClusterLines, takeTheFewestStepsBetweenThem) {
    Random random(5);
    for (int round = 0; round < 40; ++round) {
        const std::vector<TreeItem> items = randomItems(1 + random.below(10), random);
        double least = std::numeric_limits<double>::infinity();
        for (uint32_t cuts = 0; cuts < 1u << items.size(); cuts += 2) {
            std::vector<uint32_t> sizes(items.size(), 1);
            double steps = 0;
            bool fits = true;
            for (size_t i = items.size(); i-- > 0;) {
                for (const uint32_t child : items[i].children)
                    if (child != TreeItem::kNone) {
                        const bool isCut = (cuts >> child & 1) != 0;
                        steps += isCut ? items[child].weight : 0;
                        sizes[i] += isCut ? 0 : sizes[child];
                    }
                fits &= sizes[i] <= 3;
            }
            if (fits) least = std::min(least, steps);
        }
        // Lines shared by several parts can only save steps.
        EXPECT_LE(stepsBetween(items, packLines(items, 3, kAnySlots)), least + 1e-9) << round;
    }
}

}  // namespace
}  // namespace bvhio
