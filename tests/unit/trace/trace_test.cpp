#include "trace/trace.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "build/builders.h"
#include "unit/trace/brute_hits.h"

namespace bvhio {
namespace {

// Fails if a tie goes to another triangle than the lowest. That all ways of tracing agree does not show this,
// because they share the rule.
TEST(Tracer, givesTiesToTheLowestTriangle) {
    const Scene scene =
        makeScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<TriangleIndices>(9, {0, 1, 2}));
    const Ray ray{{0.25f, 0.25f, 1}, 0, {0, 0, -1}};
    EXPECT_EQ(bruteForceClosestHit(scene, ray).primitive, 0u);
    for (const uint32_t leafSize : {1u, 4u, 9u})
        for (const bool reversed : {false, true}) {  // whichever is met first
            BuildOptions options;
            options.maxLeafSize = leafSize;
            Bvh bvh = builders()[0].function(scene, options);
            AlignedVector<uint32_t> primitives(bvh.primitives.begin(), bvh.primitives.end());
            if (reversed) std::reverse(primitives.begin(), primitives.end());
            bvh.primitives = std::move(primitives);
            const EncodedBvh encoded = AabbForm(std::move(bvh));
            for (const TriangleSource source : {TriangleSource::indexed, TriangleSource::blocks}) {
                Hit hit;
                Tracer(scene, encoded, source).closestHits({&ray, 1}, {&hit, 1});
                EXPECT_EQ(hit.primitive, 0u) << "leaves of " << leafSize << (reversed ? ", reversed" : "");
            }
        }
}

}  // namespace
}  // namespace bvhio
