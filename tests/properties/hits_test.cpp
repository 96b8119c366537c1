// Tests that closest and any hits are those of brute force, bit by bit, for every builder, restructurer,
// form, source of triangles and processor.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstring>

#include "build/builders.h"
#include "common/test_rays.h"
#include "common/test_scenes.h"
#include "core/parallel.h"
#include "restructure/restructurers.h"
#include "trace/trace.h"

namespace bvhio {
namespace {

template <class Function>
void forEachForm(const Scene& scene, const Bvh& bvh, const Function& function) {
    for (const FormChoice& form : forms()) function(std::string(form.name), form.function(scene, bvh, {}));
    function("quantized-short in many clusters",
             EncodedBvh(QuantizedShortForm::encode(scene, bvh, {.pointerBits = 3, .lineSize = 16})));
}

/// Returns rays, and the same rays again with limits around their hits.
std::vector<Ray> raysFor(const Scene& scene) {
    std::vector<Ray> rays = test::awkwardRays(scene, 1, 6);
    const size_t count = rays.size();
    for (size_t i = 0; i < count; i += 3) {
        const Hit hit = bruteForceClosestHit(scene, rays[i]);
        if (hit.isMiss()) continue;
        Ray ray = rays[i];
        const float before = std::nextafter(hit.t, 0.0f), behind = std::nextafter(hit.t, 2 * hit.t + 1);
        ray.tMax = hit.t;
        rays.push_back(ray);
        ray.tMax = before;
        rays.push_back(ray);
        ray = rays[i];
        ray.tMin = hit.t;
        rays.push_back(ray);
        ray.tMin = behind;
        rays.push_back(ray);
        ray.tMax = behind;
        rays.push_back(ray);
    }
    return rays;
}

bool sameBits(const Hit& a, const Hit& b) {
    return std::memcmp(&a, &b, sizeof(Hit)) == 0;
}

/// The hits of brute force.
struct Expected {
    std::vector<Hit> hits;
    std::vector<uint8_t> occluded;

    Expected(const Scene& scene, std::span<const Ray> rays) {
        for (const Ray& ray : rays) {
            hits.push_back(bruteForceClosestHit(scene, ray));
            occluded.push_back(bruteForceAnyHit(scene, ray));
        }
    }
};

void expectHits(const Tracer& tracer, std::span<const Ray> rays, const Expected& expected) {
    std::vector<Hit> hits(rays.size());
    std::vector<uint8_t> occluded(rays.size());
    tracer.closestHits(rays, hits);
    tracer.anyHits(rays, occluded);
    for (size_t i = 0; i < rays.size(); ++i) {
        const Ray& r = rays[i];
        ASSERT_TRUE(sameBits(hits[i], expected.hits[i]))
            << "ray " << i << ": from " << r.origin.x << ' ' << r.origin.y << ' ' << r.origin.z << " along "
            << r.direction.x << ' ' << r.direction.y << ' ' << r.direction.z << " in " << r.tMin << ".."
            << r.tMax << ": t " << hits[i].t << " primitive " << hits[i].primitive << ", not "
            << expected.hits[i].t << ' ' << expected.hits[i].primitive;
        ASSERT_EQ(occluded[i], expected.occluded[i]) << "ray " << i;
        ASSERT_EQ(occluded[i] != 0, !hits[i].isMiss()) << "ray " << i;
    }
}

class HitsInScene : public testing::TestWithParam<test::TestScene> {};

TEST_P(HitsInScene, equalBruteForceForEveryBuilderAndForm) {
    const Scene scene = GetParam().make();
    const std::vector<Ray> rays = raysFor(scene);
    const Expected expected(scene, rays);
    for (const Builder& builder : builders())
        for (const uint32_t maxLeafSize : {4u, 1u, 13u}) {
            // Leaf sizes and sources of triangles do not depend on the builder.
            const bool isFirst = &builder == &builders()[0];
            if (!isFirst && maxLeafSize != 4) continue;
            forEachForm(
                scene, builder.function(scene, {.costs = {}, .maxLeafSize = maxLeafSize}),
                [&](const std::string& form, const EncodedBvh& bvh) {
                    for (const TriangleSource source : {TriangleSource::blocks, TriangleSource::indexed}) {
                        if (!isFirst && source == TriangleSource::indexed) continue;
                        SCOPED_TRACE(testing::Message() << builder.name << " leaves of " << maxLeafSize << ' '
                                                        << form << " source " << int(source));
                        expectHits(Tracer(scene, bvh, source), rays, expected);
                    }
                });
        }
}

TEST_P(HitsInScene, equalBruteForceForEveryRestructurer) {
    const Scene scene = GetParam().make();
    const std::vector<Ray> rays = raysFor(scene);
    const Expected expected(scene, rays);
    for (const Builder& builder : builders())
        for (const Restructurer& restructurer : restructurers()) {
            SCOPED_TRACE(testing::Message() << builder.name << ' ' << restructurer.name);
            const Bvh bvh = restructurer.function(scene, builder.function(scene, {}), {}).bvh;
            expectHits(Tracer(scene, AabbForm(bvh)), rays, expected);
        }
}

TEST_P(HitsInScene, areTheSameOnEveryProcessor) {
    const Scene scene = GetParam().make();
    const std::vector<Ray> rays = raysFor(scene);
    const Expected expected(scene, rays);
    const EncodedBvh bvh = AabbForm(builders()[0].function(scene, {}));
    const Tracer tracer(scene, bvh);
    const int64_t supported = hwy::SupportedTargets();
    for (int64_t targets = supported; targets != 0;
         targets &= targets - 1) {  // from the best to the most basic target
        SCOPED_TRACE(testing::Message() << hwy::TargetName(targets & -targets));
        hwy::SetSupportedTargetsForTest(targets & -targets);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        expectHits(tracer, rays, expected);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

INSTANTIATE_TEST_SUITE_P(Awkward, HitsInScene,
                         testing::ValuesIn(test::testScenes().begin(), test::testScenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Hits, andCountsDoNotDependOnThreads) {
    const Scene scene = test::sceneOf(test::randomTriangles(3000, 1, 0.1f));
    std::vector<Ray> rays;
    while (rays.size() < 40000) {
        const std::vector<Ray> more = test::awkwardRays(scene, rays.size());
        rays.insert(rays.end(), more.begin(), more.end());
    }
    const EncodedBvh bvh = AabbForm(builders()[0].function(scene, {}));
    const Tracer tracer(scene, bvh);
    std::vector<Hit> hits[2] = {std::vector<Hit>(rays.size()), std::vector<Hit>(rays.size())};
    TraceMeasurement measured[2];
    for (const size_t threads : {1, 2}) {
        const ThreadLimit limit(threads);
        tracer.closestHits(rays, hits[threads - 1]);
        measured[threads - 1] = tracer.measure(rays, QueryKind::closest);
    }
    EXPECT_EQ(std::memcmp(hits[0].data(), hits[1].data(), rays.size() * sizeof(Hit)), 0);
    EXPECT_EQ(measured[0].counts, measured[1].counts);
    EXPECT_EQ(measured[0].locality, measured[1].locality);
}

}  // namespace
}  // namespace bvhio
