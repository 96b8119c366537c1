#include "trace/visits.h"

#include <gtest/gtest.h>

#include "build/binned.h"
#include "common/test_scenes.h"
#include "core/parallel.h"
#include "rays/ray_sets.h"

namespace bvhio {
namespace {

constexpr float kForever = std::numeric_limits<float>::infinity();

// One ray goes through both leaves below the root's left child, one hits the nearer of them, one enters only
// the root, one misses the root, and one misses by definition.
TEST(Visits, countTheRaysThatFetchAPair) {
    const Scene scene = test::sceneOf({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                       {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                                       {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}}});
    AlignedVector<Node> nodes(6);
    nodes[0] = {{{0, 0, 0}, {6, 1, 1}}, 2, 0};
    nodes[1] = {};
    nodes[2] = {{{0, 0, 0}, {1, 1, 1}}, 4, 0};
    nodes[3] = {{{5, 0, 0}, {6, 1, 0}}, 2, 1};
    nodes[4] = {{{0, 0, 0}, {1, 1, 0}}, 0, 1};
    nodes[5] = {{{0, 0, 1}, {1, 1, 1}}, 1, 1};
    const Bvh bvh{std::move(nodes), std::vector<uint32_t>{0, 1, 2}};
    const Ray rays[] = {{{0.9f, 0.9f, 9}, 0, {0, 0, -1}, kForever},
                        {{0.25f, 0.25f, 9}, 0, {0, 0, -1}, kForever},
                        {{3, 0.25f, 9}, 0, {0, 0, -1}, kForever},
                        {{-3, 0.25f, 9}, 0, {0, 0, -1}, kForever},
                        {{0, 0.25f, 9}, 0, {0, 0, 0}, kForever}};
    for (const QueryKind query : {QueryKind::closest, QueryKind::any})
        EXPECT_EQ(countVisits(scene, bvh, rays, query), (std::vector<uint32_t>{4, 3, 2}));
}

TEST(Visits, areWhatMeasuringCountsAndNeverAboveTheParents) {
    const Scene scene = test::sceneOf(test::randomTriangles(500, 1, 0.2f));
    const Bvh bvh = buildBinned(scene, {});
    std::vector<Ray> rays(70000);  // more than the rays of one task
    Random random(1);
    const auto point = [&] {
        const float x = random.uniform(-1, 1), y = random.uniform(-1, 1);
        return Vec3{x, y, random.uniform(-1, 1)};
    };
    for (Ray& ray : rays) ray = {point(), 0, point(), kForever};
    const std::vector<uint32_t> visits = countVisits(scene, bvh, rays, QueryKind::closest);
    uint64_t sum = 0;
    for (const uint32_t count : visits) sum += count;
    const EncodedBvh form = AabbForm(bvh);
    EXPECT_EQ(sum, Tracer(scene, form).measure(rays, QueryKind::closest).counts.records);
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        if (i == 1 || bvh.nodes[i].isLeaf()) continue;
        EXPECT_LE(visits[bvh.nodes[i].left() / 2], visits[i / 2]);
    }
    const ThreadLimit one(1);
    EXPECT_EQ(countVisits(scene, bvh, rays, QueryKind::closest), visits);
}

}  // namespace
}  // namespace bvhio
