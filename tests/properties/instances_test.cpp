// Tests instanced scenes in every pair of forms for their levels: hits equal brute force, and files return
// what was written.
#include <gtest/gtest.h>

#include <cstring>

#include "build/builders.h"
#include "build/instanced.h"
#include "common/instanced_scenes.h"
#include "common/test_rays.h"
#include "core/parallel.h"
#include "stats/tree_stats.h"
#include "trace/trace.h"
#include "unit/file/support.h"

namespace bvhio {
namespace {

TwoLevelForm::Options levels(TlasForm tlas, BlasForm blas) {
    TwoLevelForm::Options options;
    options.tlasForm = tlas;
    options.blasForm = blas;
    return options;
}
const TwoLevelForm::Options kSmall = levels(TlasForm::quantized, BlasForm::ssh);

template <class Function>
void forEachPair(const Function& function) {
    for (size_t tlas = 0; tlas < levelForms<TlasForm>().size(); ++tlas)
        for (size_t blas = 0; blas < levelForms<BlasForm>().size(); ++blas) {
            SCOPED_TRACE(testing::Message()
                         << levelForms<TlasForm>()[tlas] << " over " << levelForms<BlasForm>()[blas]);
            function(levels(TlasForm(tlas), BlasForm(blas)));
        }
}

/// Returns awkward rays, and rays from near each instance, with and without limits.
std::vector<Ray> raysFor(const ImportedScene& imported) {
    std::vector<Ray> rays = test::awkwardRays(flatten(imported, {}), 3, 3);
    const Scene scene = shareMeshes(imported, {});
    Random random(11);
    for (const InstanceEntry& entry : instanceEntries(scene)) {
        const Vec3 center = entry.bounds.center(), extent = entry.bounds.extent();
        for (int i = 0; i < 6; ++i) {
            const float x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
            const Vec3 away{extent.x * x, extent.y * y, extent.z * z};
            rays.push_back({center + away, 0, away * -1.0f + extent * random.uniform(-0.3f, 0.3f)});
            if (i % 3 == 2) rays.back().tMax = random.uniform(0.5f, 1);
        }
    }
    return rays;
}

TEST(InstancedScenes, hitsEqualBruteForceBitByBit) {
    for (const test::InstancedScene& row : test::instancedScenes()) {
        SCOPED_TRACE(row.name);
        const Scene scene = shareMeshes(row.imported, {});
        const std::vector<Ray> rays = raysFor(row.imported);
        std::vector<Hit> expected;
        size_t hitCount = 0;
        for (const Ray& ray : rays) {
            expected.push_back(bruteForceClosestHit(scene, ray));
            hitCount += !expected.back().isMiss();
        }
        EXPECT_GT(hitCount, rays.size() / 5);
        for (const Builder& builder : builders()) {
            SCOPED_TRACE(builder.name);
            const InstancedBvh bvh = buildInstanced(scene, builder, {.costs = {}, .maxLeafSize = 13});
            forEachPair([&](const TwoLevelForm::Options& options) {
                const EncodedBvh encoded = TwoLevelForm::encodeInstances(scene, bvh, options);
                for (const TriangleSource source : {TriangleSource::indexed, TriangleSource::blocks}) {
                    const Tracer tracer(scene, encoded, source);
                    std::vector<Hit> hits(rays.size());
                    std::vector<uint8_t> occluded(rays.size());
                    tracer.closestHits(rays, hits);
                    tracer.anyHits(rays, occluded);
                    for (size_t i = 0; i < rays.size(); ++i) {
                        ASSERT_EQ(std::memcmp(&hits[i], &expected[i], sizeof(Hit)), 0)
                            << "ray " << i << ": t " << hits[i].t << " primitive " << hits[i].primitive
                            << ", not " << expected[i].t << ' ' << expected[i].primitive;
                        ASSERT_EQ(occluded[i] != 0, !expected[i].isMiss()) << "ray " << i;
                    }
                }
            });
        }
    }
}

TEST(InstancedScenes, surviveFilesInEveryForm) {
    for (const test::InstancedScene& row : test::instancedScenes()) {
        SCOPED_TRACE(row.name);
        const Scene scene = shareMeshes(row.imported, {});
        // Leaves are larger than ssh can store: their halves must stay with their mesh.
        const InstancedBvh bvh =
            buildInstanced(scene, choose(builders(), "builder", "median"), {.costs = {}, .maxLeafSize = 200});
        forEachPair([&](const TwoLevelForm::Options& options) {
            const BvhxFile file{scene, TwoLevelForm::encodeInstances(scene, bvh, options), {}, {}, {}};
            EXPECT_EQ(optionsOf(file.bvh), EncodeOptions(options));
            const BvhxFile read = readBvhx(asBytes(written(file)), "test");
            EXPECT_EQ(read.scene.meshes, scene.meshes);
            EXPECT_EQ(read.scene.instances, scene.instances);
            EXPECT_EQ(optionsOf(read.bvh), EncodeOptions(options));
            EXPECT_EQ(written(read), written(file));
            EXPECT_GT(sahCost(scene, file.bvh, {}), 0);
            // Encode again from the canonical trees.
            const auto& levels = std::get<TwoLevelForm>(read.bvh);
            const BvhxFile again{scene,
                                 TwoLevelForm::encodeInstances(scene, levels.decodeInstances(scene), options),
                                 {},
                                 {},
                                 {}};
            EXPECT_NO_THROW(readBvhx(asBytes(written(again)), "again"));
        });
    }
}

// More instances in one place than a leaf or a node has room for: the depth must stay within its limit.
TEST(InstancedScenes, thousandsInOnePlace) {
    ImportedScene imported{{test::meshOf("grid", test::gridScene(1, [](float, float) { return 0.5f; }))},
                           std::vector<Instance>(3000)};
    const Scene scene = shareMeshes(imported, {});
    for (const Builder& builder : builders()) {
        const EncodedBvh bvh =
            TwoLevelForm::encodeInstances(scene, buildInstanced(scene, builder, {}), kSmall);
        const std::vector<Ray> rays{{{0.25f, 0.25f, 0}, 0, {0, 0, 1}}, {{0.25f, 0.25f, 1}, 0, {0, 0, 1}}};
        std::vector<Hit> hits(2);
        Tracer(scene, bvh).closestHits(rays, hits);
        EXPECT_EQ(hits[0].primitive, 0u) << builder.name;
        EXPECT_TRUE(hits[1].isMiss());
        EXPECT_NO_THROW(readBvhx(asBytes(written({scene, bvh, {}, {}, {}})), "test"));
    }
}

// One mesh in one place costs as much as its tree. So do two instances that are apart, each with half the
// probability.
TEST(InstancedScenes, costIsThatOfTheMeshWhereTheInstanceIsEntered) {
    const Scene sphere = test::sphereScene(16, 8);
    const Builder& builder = builders()[0];
    const double plain = sahCost(builder.function(sphere, {}), {});
    const Transform shifted{1, 0, 0, 100, 0, 1, 0, 0, 0, 0, 1, 0};
    const auto cost = [&](std::vector<Instance> instances) {
        const Scene scene = shareMeshes({{test::meshOf("sphere", sphere)}, std::move(instances)}, {});
        return treeStats(scene, buildInstanced(scene, builder, {}), {}).sahCost;
    };
    EXPECT_NEAR(cost({{0, kIdentityTransform}}), plain, 1e-9 * plain);
    // The root's half area is that of a box of 102 x 2 x 2, a sphere's that of one of 2 x 2 x 2.
    EXPECT_NEAR(cost({{0, kIdentityTransform}, {0, shifted}}), 1.2 + 2 * plain * 12 / (2 * 102 * 2 + 4),
                0.01 * plain);
}

TEST(InstancedScenes, treesDoNotMakeOne) {
    const Scene scene = shareMeshes(test::instancedScenes()[0].imported, {});
    const EncodedBvh bvh =
        TwoLevelForm::encodeInstances(scene, buildInstanced(scene, builders()[0], {}), kSmall);
    EXPECT_THROW(decode(bvh), Error);
}

}  // namespace
}  // namespace bvhio
