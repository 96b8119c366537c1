#include "trace/step_mvh.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace bvhio {
namespace {

using namespace HWY_NAMESPACE;

/// A node whose box is computed and clipped node by node.
struct ExpectedNode {
    MvhBox box;
    RayInterval interval;
    uint32_t axis = 0;  // along which its children are cut

    ExpectedNode child(const PreparedRay& ray, const MvhRule& rule, uint32_t code, float tLimit) const {
        ExpectedNode child{MvhCuts(box, rule).child(box, code), {}};
        child.interval = clipToBox(ray, child.box.bounds, tLimit);
        child.interval.enter = std::max(child.interval.enter, interval.enter);
        child.interval.exit = std::min(child.interval.exit, interval.exit);
        child.axis = MvhCuts(child.box, rule).axis;
        return child;
    }
    /// Returns whether a ray enters this node's right child first.
    bool isSwapped(const PreparedRay& ray, const ExpectedNode& left, const ExpectedNode& right) const {
        return right.interval.enter < left.interval.enter ||
               (right.interval.enter == left.interval.enter && ray.nearPlane[axis] >= 3);
    }
};

class MvhStepTest : public testing::Test {
  protected:
    uint32_t below(uint32_t n) { return random_.below(n); }
    float number() { return float(below(4096)) / 256 - 8; }
    /// Returns boxes with whole and other numbers, with axes without extent, and with extents beyond floats.
    Aabb box() {
        Aabb box;
        for (int axis = 0; axis < 3; ++axis) {
            const float low = below(3) == 0 ? float(below(4)) : number();
            box.min[axis] = low;
            box.max[axis] = low + (below(4) == 0 ? 0 : float(below(5)));
            if (below(20) == 0) {
                box.min[axis] = -std::numeric_limits<float>::max();
                box.max[axis] = std::numeric_limits<float>::max();
            }
        }
        return box;
    }
    Ray ray() {
        Ray ray{{number(), number(), number()}, 0, {}, std::numeric_limits<float>::infinity()};
        for (int axis = 0; axis < 3; ++axis) {
            if (below(3) == 0) ray.origin[axis] = float(below(4));
            const float directions[] = {0, -0.0f, 1, -1, number(), number(), number(), number()};
            ray.direction[axis] = directions[below(8)];
        }
        return ray;
    }

    Random random_{1};
};

// Steps of two levels in four lanes must find, bit for bit, the same as boxes that are computed node by node:
// a plane that differs in one bit loses hits.
TEST_F(MvhStepTest, findsTheSameAsBoxesNodeByNode) {
    size_t steps = 0, entered = 0;
    while (steps < 20000) {
        const MvhRule rule{0.25f + float(below(64)) / 256, 0.25f, 1 + below(3)};
        const MvhTables tables(rule);
        const PreparedRay ray(this->ray());
        const float tLimit = below(4) == 0 ? float(below(16)) : std::numeric_limits<float>::infinity();
        ExpectedNode node{{box(), below(rule.axes)}, {}};
        if (ray.missesByDefinition()) continue;
        node.interval = clipToBox(ray, node.box.bounds, tLimit);
        if (node.interval.isEmpty()) continue;
        ++steps;
        node.axis = MvhCuts(node.box, rule).axis;
        const bool twoLevels = below(4) != 0;
        const uint32_t codes[3] = {below(16), twoLevels ? below(16) : 0, twoLevels ? below(16) : 0};

        const MvhRay mvhRay(ray);
        MvhStep step;
        stepMvh(tables, mvhRay, codes[0], codes[1], codes[2], twoLevels,
                mvhPart(mvhRay, node.box.bounds, node.interval), node.box.turn, tLimit, step);

        ExpectedNode children[2], lanes[4];
        uint32_t swapped[3] = {};
        for (uint32_t i = 0; i < 2; ++i) {
            children[i] = node.child(ray, rule, codes[0] >> 2 * i & 3, tLimit);
            for (uint32_t k = 0; k < 2; ++k)
                lanes[2 * i + k] =
                    twoLevels ? children[i].child(ray, rule, codes[1 + i] >> 2 * k & 3, tLimit) : children[i];
            swapped[1 + i] = twoLevels && children[i].isSwapped(ray, lanes[2 * i], lanes[2 * i + 1]);
        }
        swapped[0] = node.isSwapped(ray, children[0], children[1]);
        uint32_t count = 0;
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t child = i / 2 ^ swapped[0], lane = 2 * child + (i % 2 ^ swapped[1 + child]);
            const ExpectedNode& expected = lanes[lane];
            if (expected.interval.isEmpty() || (!twoLevels && lane % 2 == 1)) continue;
            ASSERT_LT(count, step.count) << steps;
            ASSERT_EQ(step.lane(count), lane) << steps;
            ++count;
            const MvhPart& part = step.parts[lane];
            ASSERT_EQ(part.enter(), expected.interval.enter) << steps;
            ASSERT_EQ(-part.far[3], expected.interval.exit) << steps;
            ASSERT_EQ(uint32_t(step.turns[lane]), expected.box.turn) << steps;
            for (int axis = 0; axis < 3; ++axis) {
                const Aabb& bounds = expected.box.bounds;
                const bool backwards = ray.nearPlane[axis] >= 3;
                ASSERT_EQ(part.near[axis], (backwards ? bounds.max : bounds.min)[axis]) << steps;
                ASSERT_EQ(part.far[axis], (backwards ? bounds.min : bounds.max)[axis]) << steps;
            }
        }
        ASSERT_EQ(step.count, count) << steps;
        entered += count;
    }
    EXPECT_GT(entered, steps);
}

}  // namespace
}  // namespace bvhio
