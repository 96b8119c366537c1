#include "build/reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/test_scenes.h"

namespace bvhio {
namespace {

// After the last vertex of the array nothing may be read. Only sanitizers detect that.
TEST(Reference, holdsItsTrianglesBox) {
    const Scene scene = test::gridScene(20, [](float x, float y) { return x * y - 7; });
    Buffer<Reference> references;
    Box bounds;
    EXPECT_FALSE(makeReferences(scene, references, bounds));
    Aabb whole = Aabb::empty();
    for (size_t i = 0; i < scene.triangles.size(); ++i) {
        const Aabb box = bvhio::bounds(scene.triangle(i));
        whole.extend(box);
        EXPECT_EQ(references[i].primitive, i);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(references[i].negatedMin[axis], -box.min[axis]);
            EXPECT_EQ(references[i].max[axis], box.max[axis]);
            EXPECT_EQ(references[i].centroid(axis), box.min[axis] + box.max[axis]);
            // With -0, unions would depend on their order.
            EXPECT_FALSE(references[i].negatedMin[axis] == 0 && std::signbit(references[i].negatedMin[axis]));
        }
    }
    EXPECT_EQ(bounds.toAabb(), whole);
}

// The areas of boxes 1e38 or 1e-30 across do not fit a float.
TEST(Reference, rescalesExtremeScenesByAPowerOfTwo) {
    for (const float scale : {0x1p+120f, 0x1p-120f, 0x1p-140f}) {
        std::vector<Triangle> triangles = test::randomTriangles(20, 1, 0.1f);
        for (Triangle& t : triangles)
            for (Vec3* v : {&t.v0, &t.v1, &t.v2}) *v = *v * scale;
        Buffer<Reference> references;
        Box bounds;
        EXPECT_TRUE(makeReferences(test::sceneOf(triangles), references, bounds));
        EXPECT_GT(bounds.halfArea(), 1e-8f);  // the largest power of a float, 2^127, brings 2^-140 to 2^-13
        EXPECT_LT(bounds.halfArea(), 100.0f);
        const float ratio = references[3].max[1] / bvhio::bounds(triangles[3]).max.y;
        int exponent = 0;
        EXPECT_EQ(std::frexp(ratio, &exponent), 0.5f);
    }
}

}  // namespace
}  // namespace bvhio
