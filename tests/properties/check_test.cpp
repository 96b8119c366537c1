// Tests that for every form the check finds a file in which a triangle extends outside its box by a single
// bit.
#include "file/check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "build/builders.h"
#include "common/test_scenes.h"
#include "unit/file/support.h"

namespace bvhio {
namespace {

/// Returns the scene with a corner moved to `x`. Its triangle shares no vertices.
Scene withCornerAt(const Scene& scene, uint32_t triangle, float x) {
    std::vector<Vec3> vertices(scene.vertices.begin(), scene.vertices.end());
    vertices[scene.triangles[triangle].v0].x = x + 0.0f;
    Scene changed = scene;
    changed.vertices = std::move(vertices);
    return changed;
}

bool findsOutsider(const Scene& scene, const EncodedBvh& encoded) {
    const std::string bytes = written({scene, encoded, {}, {}, {}});
    bool found = false;
    for (const Finding& finding : checkBytes(asBytes(bytes), "test"))
        found |= finding.id == FindingId::primitiveOutsideLeaf;
    return found;
}

TEST(Check, findsEachTriangleThatLeavesItsLeafByOneFloat) {
    const Scene scene = test::sceneOf(test::randomTriangles(40, 1, 0.2f));
    const Bvh bvh = builders()[0].function(scene, {});
    for (const FormChoice& form : forms()) {
        const EncodedBvh encoded = form.function(scene, bvh, {});
        const Bvh decoded = decode(encoded);
        for (const Node& leaf : decoded.nodes)
            for (uint32_t i = leaf.first; i < leaf.first + leaf.primitiveCount; ++i) {
                const uint32_t triangle = decoded.primitives[i];
                SCOPED_TRACE(testing::Message() << form.name << " triangle " << triangle);
                const float last = leaf.bounds.max.x;
                EXPECT_FALSE(findsOutsider(withCornerAt(scene, triangle, last), encoded));
                EXPECT_TRUE(
                    findsOutsider(withCornerAt(scene, triangle, std::nextafter(last, 9.0f)), encoded));
            }
    }
}

}  // namespace
}  // namespace bvhio
