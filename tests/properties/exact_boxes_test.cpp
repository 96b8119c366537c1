// Tests that exact boxes can be found again from the larger boxes of every form.
#include "compress/exact_boxes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "build/builders.h"
#include "common/test_rays.h"
#include "common/test_scenes.h"
#include "compress/forms.h"
#include "scene/triangle_bounds.h"
#include "stats/hashes.h"
#include "trace/trace.h"
#include "tree/validate.h"

namespace bvhio {
namespace {

class ExactBoxesInScene : public testing::TestWithParam<test::TestScene> {};

TEST_P(ExactBoxesInScene, areThoseThatABuilderMade) {
    const Scene scene = GetParam().make();
    for (const Builder& builder : builders()) {
        const Bvh bvh = builder.function(scene, {});
        if (bvh.primitives.size() > scene.triangles.size()) continue;  // tested below
        for (const FormChoice& form : forms()) {
            SCOPED_TRACE(testing::Message() << builder.name << ' ' << form.name);
            const Bvh decoded = decode(form.function(scene, bvh, {}));
            if (topologyHash(decoded) != topologyHash(bvh)) continue;  // the form made a tree of its own
            EXPECT_EQ(boundsHash(withExactBoxes(scene, decoded)), boundsHash(bvh));
        }
    }
}

// A part of a split triangle that is too small would lose hits, and one that is too large would gain nothing.
TEST_P(ExactBoxesInScene, ofSplitTrianglesKeepTheHits) {
    const Scene scene = GetParam().make();
    const Bvh bvh = choose(builders(), "builder", "spatial")
                        .function(scene, {.costs = {1, 8}, .maxLeafSize = 1, .splitBudget = 2});
    const std::vector<Ray> rays = test::awkwardRays(scene, 9, 4);
    for (const FormChoice& form : forms()) {
        SCOPED_TRACE(form.name);
        const Bvh decoded = decode(form.function(scene, bvh, {}));
        const Bvh exact = withExactBoxes(scene, decoded);
        EXPECT_EQ(topologyHash(exact), topologyHash(decoded));
        for (size_t i = 0; i < exact.nodes.size(); ++i)
            ASSERT_TRUE(decoded.nodes[i].bounds.contains(exact.nodes[i].bounds)) << "node " << i;
        for (const Finding& finding :
             validate(exact, uint32_t(scene.triangles.size()), boundsOfTriangles(scene)).findings)
            ADD_FAILURE() << finding.message;
        const EncodedBvh encoded = AabbForm(exact);
        std::vector<Hit> hits(rays.size());
        Tracer(scene, encoded).closestHits(rays, hits);
        for (size_t i = 0; i < rays.size(); ++i) {
            const Hit expected = bruteForceClosestHit(scene, rays[i]);
            ASSERT_EQ(std::memcmp(&hits[i], &expected, sizeof(Hit)), 0) << "ray " << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Awkward, ExactBoxesInScene,
                         testing::ValuesIn(test::testScenes().begin(), test::testScenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace bvhio
