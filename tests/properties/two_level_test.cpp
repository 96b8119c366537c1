// Tests the two-level form with every pair of forms for its levels, over awkward scenes: hits equal brute
// force, boxes contain those that they were made from, and files return what was written.
#include <gtest/gtest.h>

#include <cstring>

#include "build/builders.h"
#include "common/test_rays.h"
#include "common/test_scenes.h"
#include "scene/triangle_bounds.h"
#include "stats/hashes.h"
#include "trace/trace.h"
#include "tree/validate.h"
#include "unit/file/support.h"

namespace bvhio {
namespace {

template <class Function>
void forEachPair(const Function& function) {
    for (size_t tlas = 0; tlas < levelForms<TlasForm>().size(); ++tlas)
        for (size_t blas = 0; blas < levelForms<BlasForm>().size(); ++blas)
            for (const uint32_t blasSize : {1u, 3u, 16u, 70u, kMaxLeafSize}) {
                SCOPED_TRACE(testing::Message() << levelForms<TlasForm>()[tlas] << " over "
                                                << levelForms<BlasForm>()[blas] << " of " << blasSize);
                TwoLevelForm::Options options;
                options.tlasForm = TlasForm(tlas);
                options.blasForm = BlasForm(blas);
                options.blasSize = blasSize;
                if (options.blasForm == BlasForm::mvh && blasSize <= 70)
                    options.blasLeafSize = blasSize == 70 ? 3 : 4;
                function(options);
            }
}

class TwoLevelInScene : public testing::TestWithParam<test::TestScene> {};

TEST_P(TwoLevelInScene, hitsEqualBruteForce) {
    const Scene scene = GetParam().make();
    const std::vector<Ray> rays = test::awkwardRays(scene, 3, 6);
    std::vector<Hit> expected;
    for (const Ray& ray : rays) expected.push_back(bruteForceClosestHit(scene, ray));
    for (const uint32_t maxLeafSize : {1u, 13u}) {
        const Bvh bvh = builders()[0].function(scene, {.costs = {}, .maxLeafSize = maxLeafSize});
        forEachPair([&](const TwoLevelForm::Options& options) {
            const EncodedBvh encoded = TwoLevelForm::encode(scene, bvh, options);
            for (const TriangleSource source : {TriangleSource::blocks, TriangleSource::indexed}) {
                if (source == TriangleSource::indexed && maxLeafSize == 1) continue;
                const Tracer tracer(scene, encoded, source);
                std::vector<Hit> hits(rays.size());
                std::vector<uint8_t> occluded(rays.size());
                tracer.closestHits(rays, hits);
                tracer.anyHits(rays, occluded);
                for (size_t i = 0; i < rays.size(); ++i) {
                    ASSERT_EQ(std::memcmp(&hits[i], &expected[i], sizeof(Hit)), 0) << "ray " << i;
                    ASSERT_EQ(occluded[i] != 0, !expected[i].isMiss()) << "ray " << i;
                }
            }
        });
    }
}

TEST_P(TwoLevelInScene, decodesToValidTreesAndSurvivesFiles) {
    const Scene scene = GetParam().make();
    const Bvh bvh = builders()[0].function(scene, {.costs = {}, .maxLeafSize = 6});
    forEachPair([&](const TwoLevelForm::Options& options) {
        const EncodedBvh encoded = TwoLevelForm::encode(scene, bvh, options);
        EXPECT_EQ(optionsOf(encoded), EncodeOptions(options));
        const Bvh decoded = decode(encoded);
        for (const Finding& finding :
             validate(decoded, uint32_t(scene.triangles.size()), boundsOfTriangles(scene)).findings)
            ADD_FAILURE() << finding.message;
        EXPECT_TRUE(decoded.nodes[0].bounds.contains(bvh.nodes[0].bounds));
        const BvhxFile file{scene, encoded, {}, {}, {}};
        const BvhxFile read = readBvhx(asBytes(written(file)), "test");
        expectSameContent(file, read);
        EXPECT_EQ(optionsOf(read.bvh), EncodeOptions(options));
    });
}

INSTANTIATE_TEST_SUITE_P(Awkward, TwoLevelInScene,
                         testing::ValuesIn(test::testScenes().begin(), test::testScenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace bvhio
