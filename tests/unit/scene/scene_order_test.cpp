#include "scene/scene_order.h"

#include <gtest/gtest.h>

#include <set>

#include "unit/file/support.h"

namespace bvhio {
namespace {

bool sameBits(const Triangle& a, const Triangle& b) {
    return a.v0 == b.v0 && a.v1 == b.v1 && a.v2 == b.v2;
}

TEST(SceneOrder, verticesByUseAreTheSameTriangles) {
    Scene scene = sampleScene(40);
    AlignedVector<TriangleIndices> triangles(scene.triangles.begin(), scene.triangles.end());
    std::reverse(triangles.begin(), triangles.end());
    triangles[3] = triangles[7];  // leaves vertices without a triangle
    scene.triangles = std::move(triangles);
    const Scene byUse = withVerticesByUse(scene);
    ASSERT_EQ(byUse.vertices.size(), scene.vertices.size());
    uint32_t highest = 0;
    for (size_t i = 0; i < scene.triangles.size(); ++i) {
        EXPECT_TRUE(sameBits(byUse.triangle(i), scene.triangle(i))) << i;
        const TriangleIndices& t = byUse.triangles[i];
        for (const uint32_t vertex : {t.v0, t.v1, t.v2}) {
            EXPECT_LE(vertex, highest) << i;  // a vertex's first use takes the next number
            highest = std::max(highest, vertex + 1);
        }
    }
    std::multiset<float> before, after;
    for (const Vec3& v : scene.vertices) before.insert(v.x);
    for (const Vec3& v : byUse.vertices) after.insert(v.x);
    EXPECT_EQ(before, after);
    EXPECT_EQ(byUse.geometries, scene.geometries);
}

TEST(SceneOrder, trianglesKeepTheirIdsAndGeometriesTheirRuns) {
    for (const bool dropped : {false, true}) {
        Scene scene = sampleScene(50);
        if (dropped) {
            std::vector<uint32_t> source(50);
            for (uint32_t i = 0; i < 50; ++i) source[i] = 2 * i + 1;
            scene.sourcePrimitives = std::move(source);
        }
        std::vector<uint32_t> entries;
        for (uint32_t i = 0; i < 50; ++i) entries.push_back(i * 7 % 50);
        entries.insert(entries.begin() + 20, {entries[3], entries[40]});  // split triangles come twice
        const ReorderedScene reordered = withTrianglesInOrder(scene, entries);
        EXPECT_EQ(reordered.scene.geometries, scene.geometries);
        std::set<uint32_t> places;
        for (uint32_t i = 0; i < 50; ++i) {
            const uint32_t place = reordered.newIndex[i];
            places.insert(place);
            EXPECT_TRUE(sameBits(reordered.scene.triangle(place), scene.triangle(i))) << i;
            const auto before = scene.primitiveId(i), after = reordered.scene.primitiveId(place);
            EXPECT_EQ(after.geometry, before.geometry) << i;
            EXPECT_EQ(after.primitive, before.primitive) << i;
        }
        EXPECT_EQ(places.size(), 50u);
        // Within a geometry, triangles are in the order of first use by the entries.
        std::vector<uint32_t> last(scene.geometries.size());
        std::set<uint32_t> named;
        for (const uint32_t entry : entries) {
            if (!named.insert(entry).second) continue;
            const uint32_t geometry = scene.primitiveId(entry).geometry, place = reordered.newIndex[entry];
            EXPECT_EQ(place, reordered.scene.geometries[geometry].firstTriangle + last[geometry]++);
        }
    }
}

}  // namespace
}  // namespace bvhio
