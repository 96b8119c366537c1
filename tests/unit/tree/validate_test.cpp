#include "tree/validate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>

#include "core/parallel.h"
#include "core/random.h"
#include "tree/refit.h"

namespace bvhio {
namespace {

/// Primitives that are points on a line, so that a tree over them is easy to write down.
struct Points {
    std::vector<Vec3> at;
    PrimitiveBounds bounds() const {
        return [this](std::span<const uint32_t> primitives, Aabb* boxes) {
            for (const uint32_t p : primitives) *boxes++ = {at[p], at[p]};
        };
    }
};

Points line(uint32_t count) {
    Points points;
    for (uint32_t i = 0; i < count; ++i) points.at.push_back({float(i), 0, 0});
    return points;
}

/// Returns a balanced tree with one point in each leaf, and nodes in breadth-first order.
Bvh tree(const Points& points) {
    AlignedVector<Node> nodes(2);
    nodes[1] = {};
    std::vector<std::array<uint32_t, 3>> queue{{0, 0, uint32_t(points.at.size())}};
    std::vector<uint32_t> primitives(points.at.size());
    for (size_t next = 0; next < queue.size(); ++next) {
        const auto [slot, first, count] = queue[next];
        nodes[slot] = {{points.at[first], points.at[first + count - 1]}, first, 1};
        primitives[first] = first;
        if (count == 1) continue;
        const auto left = uint32_t(nodes.size());
        nodes.resize(left + 2);
        nodes[slot].first = left;
        nodes[slot].primitiveCount = 0;
        queue.push_back({left, first, count / 2});
        queue.push_back({left + 1, first + count / 2, count - count / 2});
    }
    return {std::move(nodes), std::move(primitives)};
}

/// Returns the tree with a change to its nodes.
template <class Change>
Bvh changed(const Bvh& bvh, const Change& change) {
    AlignedVector<Node> nodes(bvh.nodes.begin(), bvh.nodes.end());
    change(nodes);
    return {std::move(nodes), bvh.primitives};
}

std::vector<FindingId> ids(const Validation& validation) {
    std::vector<FindingId> found;
    for (const Finding& finding : validation.findings) found.push_back(finding.id);
    return found;
}

TEST(Validate, findsNothingInAGoodTreeAndItsDepth) {
    for (const uint32_t count : {1u, 2u, 3u, 64u, 65u, 50000u}) {
        const Points points = line(count);
        const Validation validation = validate(tree(points), count, points.bounds());
        EXPECT_TRUE(validation.findings.empty()) << count << ": " << validation.findings[0].message;
        EXPECT_EQ(validation.depth, count == 1 ? 0u : uint32_t(std::bit_width(count - 1))) << count;
    }
}

// The wrong field is far into the array, where another thread than the first checks it.
TEST(Validate, findsOneWrongFieldAnywhere) {
    const uint32_t count = 40000;
    const Points points = line(count);
    const Bvh good = tree(points);
    const auto expectOnly = [&](FindingId id, const auto& change) {
        const auto found = ids(validate(changed(good, change), count, points.bounds()));
        ASSERT_FALSE(found.empty()) << uint32_t(id);
        EXPECT_EQ(found.front(), id);
    };
    const size_t inner = 30000, leaf = 70000;
    ASSERT_FALSE(good.nodes[inner].isLeaf());
    ASSERT_TRUE(good.nodes[leaf].isLeaf());
    expectOnly(FindingId::childIndex, [&](auto& n) { n[inner].first += 1; });
    expectOnly(FindingId::childIndex, [&](auto& n) { n[inner].first = uint32_t(inner); });
    expectOnly(FindingId::childIndex, [&](auto& n) { n[inner].first = uint32_t(n.size()); });
    expectOnly(FindingId::childOutsideParent, [&](auto& n) { n[inner].bounds.max.x -= 1; });
    expectOnly(FindingId::leafRange, [&](auto& n) { n[leaf].primitiveCount = count; });
    expectOnly(FindingId::primitiveOutsideLeaf, [&](auto& n) { n[leaf].bounds = n[leaf ^ 1].bounds; });
    expectOnly(FindingId::boxNotFinite, [&](auto& n) { n[leaf].bounds.min.y = std::nanf(""); });
    expectOnly(FindingId::unusedSlot, [&](auto& n) { n[1].first = 1; });
}

// Two wrong pointers that leave every count right: one pair has two parents, and another one has none.
TEST(Validate, findsSharedChildren) {
    const Points points = line(4);
    const Bvh bvh = changed(tree(points), [](auto& nodes) {
        nodes[3] = nodes[2];
        nodes[0].bounds = nodes[2].bounds;
    });
    const auto found = ids(validate(bvh, 4, points.bounds()));
    EXPECT_EQ(std::count(found.begin(), found.end(), FindingId::sharedChildren), 2);
}

TEST(Validate, saysTheSameForAnyThreadsAndStopsAfterSome) {
    const uint32_t count = 100000;
    const Points points = line(count);
    const Bvh bvh = changed(tree(points), [](auto& nodes) {
        for (Node& node : nodes)
            if (node.isLeaf()) node.bounds.max.x = node.bounds.min.x = -1;
    });
    const auto text = [&] {
        std::string all;
        for (const Finding& f : validate(bvh, count, points.bounds(), 3).findings) all += f.message + "\n";
        return all;
    };
    const std::string several = text();
    EXPECT_EQ(std::count(several.begin(), several.end(), '\n'), 6);
    const ThreadLimit limit(1);
    EXPECT_EQ(text(), several);
}

TEST(Validate, acceptsTheDeepestTreeAndNoDeeper) {
    for (const uint32_t levels : {kMaxDepth, kMaxDepth + 1}) {
        const Points points{std::vector<Vec3>(levels + 1)};
        AlignedVector<Node> nodes{{{}, 2, 0}, {}};
        std::vector<uint32_t> primitives;
        for (uint32_t level = 0; level < levels; ++level) {
            primitives.push_back(level);
            nodes.push_back({{}, level, 1});
            nodes.push_back(
                {{}, level + 1 == levels ? levels : uint32_t(nodes.size() + 1), level + 1 == levels});
        }
        primitives.push_back(levels);
        const auto found =
            ids(validate({std::move(nodes), std::move(primitives)}, levels + 1, points.bounds()));
        EXPECT_EQ(found, levels == kMaxDepth ? std::vector<FindingId>{} : std::vector{FindingId::depth});
    }
}

TEST(Refit, fitsEveryBoxToPrimitivesThatMoved) {
    const uint32_t count = 1000;
    Points points = line(count);
    const Bvh bvh = tree(points);
    Random random(3);
    for (Vec3& p : points.at) p = {random.uniform(), random.uniform(), random.uniform()};
    ASSERT_FALSE(validate(bvh, count, points.bounds()).findings.empty());
    const Bvh fitted = refit(bvh, points.bounds());
    EXPECT_TRUE(validate(fitted, count, points.bounds()).findings.empty());
    Aabb all = Aabb::empty();
    for (const Vec3& p : points.at) all.extend(p);
    EXPECT_EQ(fitted.nodes[0].bounds, all);
}

}  // namespace
}  // namespace bvhio
