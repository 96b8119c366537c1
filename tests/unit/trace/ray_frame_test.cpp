#include "trace/ray_frame.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "compress/inset_box.h"
#include "core/random.h"

namespace bvhio {
namespace {

using namespace HWY_NAMESPACE;

constexpr float kInf = std::numeric_limits<float>::infinity();

/// A root box and, after 96 random steps, how a ray sees each box on the way down.
struct Chain {
    Aabb bounds;
    std::vector<std::array<float, 6>> fractions;  // of min x, y, z and max x, y, z, in each step
};

Chain randomChain(Random& random) {
    const float scales[] = {1, 1e-3f, 1e6f, 1e-30f, 1e30f};
    const float scale = scales[random.below(5)];
    const float offset = random.below(3) == 0 ? 1000 * scale : 0;
    Chain chain{Aabb::empty(), {}};
    for (int corner = 0; corner < 2; ++corner)
        chain.bounds.extend(Vec3{offset + scale * random.uniform(-1, 1), scale * random.uniform(-1, 1),
                                 random.below(8) == 0 ? scale : scale * random.uniform(-100, 100)});
    const uint32_t zoom = random.below(2) ? 250 : 8;  // towards one place quickly, or slowly
    for (uint32_t step = 0; step < kMaxDepth; ++step) {
        std::array<float, 6> f{};
        for (size_t axis = 0; axis < 3; ++axis) {
            const uint32_t a = random.below(2) ? random.below(zoom) : 0, b = random.below(257 - a);
            f[axis] = float(a) / 256;
            f[axis + 3] = float(random.below(2) ? std::min(b, zoom) : 0) / 256;
            if (random.below(2)) std::swap(f[axis], f[axis + 3]);
        }
        chain.fractions.push_back(f);
    }
    return chain;
}

Ray randomRay(Random& random, const Aabb& bounds) {
    const Vec3 size = bounds.max - bounds.min;
    const auto anywhere = [&](float from, float to) {
        const float x = random.uniform(from, to), y = random.uniform(from, to);
        return bounds.min + Vec3{size.x * x, size.y * y, size.z * random.uniform(from, to)};
    };
    Ray ray{random.below(3) == 0 ? anywhere(-10, 10) : anywhere(0, 1), 0, {}, kInf};
    if (random.below(4) == 0) ray.origin[int(random.below(3))] = bounds.min[int(random.below(3))];
    ray.direction = anywhere(0, 1) - ray.origin;
    const float odd[] = {0.0f, -0.0f, 1e-42f, -1e-33f, 1e33f, 1, -1};
    if (random.below(4) == 0) ray.direction[int(random.below(3))] = odd[random.below(7)];
    if (random.below(4) == 0)
        ray.direction = Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (random.below(4) == 0) ray.tMin = random.uniform(0, 2);
    return ray;
}

/// Takes one step in both spaces.
void step(const InsetFrame& insets, const std::array<float, 6>& f, PlacedBox& placed, InsetBox& box) {
    const Four size = placed.size();
    placed.min = placed.min + Four{f[0], f[1], f[2], 1} * size;
    placed.max = placed.max - Four{f[3], f[4], f[5], 1} * size;
    for (int axis = 0; axis < 3; ++axis) {
        const double extent = insets.size(box, axis);
        box.min[axis] += f[size_t(axis)] * extent;
        box.max[axis] += f[size_t(axis) + 3] * extent;
    }
}

// The contract of every form: a ray that clipToBox accepts is accepted, and enters no later. Without the
// margin this test fails within a few chains.
TEST(RayFrame, acceptsWhateverClipToBoxAcceptsAllTheWayDown) {
    Random random(1);
    size_t regular = 0, entered = 0;
    for (int i = 0; i < 1500; ++i) {
        const Chain chain = randomChain(random);
        const InsetFrame insets(chain.bounds);
        for (int j = 0; j < 6; ++j) {
            const Ray given = randomRay(random, chain.bounds);
            const PreparedRay ray(given);
            if (ray.missesByDefinition()) continue;
            const RayFrame frame(ray, chain.bounds);
            regular += frame.isRegular();
            PlacedBox placed = frame.root();
            InsetBox box;
            for (const auto& f : chain.fractions) {
                step(insets, f, placed, box);
                const Aabb floats = insets.floats(box);
                if (floats.isEmpty()) break;
                for (const float limit : {kInf, clipToBox(ray, floats, kInf).exit}) {
                    const RayInterval exact = clipToBox(ray, floats, limit);
                    if (exact.isEmpty()) continue;
                    ++entered;
                    const RayInterval found = frame.clip(placed, limit);
                    ASSERT_FALSE(found.isEmpty()) << i << ' ' << j;
                    ASSERT_LE(found.enter, exact.enter) << i << ' ' << j;
                    ASSERT_GE(found.exit, exact.exit) << i << ' ' << j;
                }
            }
        }
    }
    EXPECT_GT(regular, 3000u);
    EXPECT_GT(entered, 50000u);
}

// The lemma itself, against long double: the remaining margin is what the proof says, and the box does not
// move much further than the margin.
TEST(RayFrame, keepsTheMarginThatItProves) {
    constexpr long double u = 0x1p-24L;
    Random random(2);
    size_t compared = 0;
    for (int i = 0; i < 1500; ++i) {
        const Chain chain = randomChain(random);
        const InsetFrame insets(chain.bounds);
        const PreparedRay ray(randomRay(random, chain.bounds));
        if (ray.missesByDefinition()) continue;
        const RayFrame frame(ray, chain.bounds);
        if (!frame.isRegular()) continue;
        PlacedBox placed = frame.root();
        InsetBox box;
        for (const auto& f : chain.fractions) {
            step(insets, f, placed, box);
            for (int axis = 0; axis < 3; ++axis) {
                const auto place = [&](long double from, double inset) {
                    return (from + inset - ray.origin[axis]) / ray.direction[axis];
                };
                const float lower = chain.bounds.min[axis], upper = chain.bounds.max[axis];
                const long double sign = ray.direction[axis] < 0 ? -1 : 1;
                const long double largest = std::max(std::abs(place(lower, 0)), std::abs(place(upper, 0)));
                // All places are shifted by the margin, 128 u; the test's boxes by as much outwards.
                const long double below = sign * (place(lower, box.min[axis]) - placed.min[axis]);
                const long double above = sign * (place(upper, -box.max[axis]) - placed.max[axis]);
                for (const long double shift : {below, above}) {
                    ASSERT_GE(shift, 20 * u * largest);
                    ASSERT_LE(shift, 236 * u * largest + 0x1p-119L);
                    ++compared;
                }
            }
            ASSERT_EQ(placed.min[3], ray.tMin);
        }
    }
    EXPECT_GT(compared, 100000u);
}

// The extent of the scene overflows a float: every box is entered.
TEST(RayFrame, entersEveryBoxWhereExtentsOverflow) {
    const float far = std::numeric_limits<float>::max();
    const PreparedRay ray(Ray{{-far, -far, -far}, 0, {1, 1, 1}});
    const RayFrame frame(ray, {{-far, -far, -far}, {far, far, far}});
    EXPECT_FALSE(frame.isRegular());
    const RayInterval part = frame.clip(frame.root(), kInf);
    EXPECT_EQ(part.enter, 0);
    EXPECT_EQ(part.exit, kInf);
}

}  // namespace
}  // namespace bvhio
