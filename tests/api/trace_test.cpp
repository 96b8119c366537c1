// Rays through the API: hits are those of every triangle tested in turn, in batches and one by one, plain and
// instanced.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "api/handles.h"
#include "core/random.h"

namespace apitest {
namespace {

std::vector<BvhioRay> randomRays(size_t count) {
    bvhio::Random random(3);
    std::vector<BvhioRay> rays(count);
    for (BvhioRay& ray : rays) {
        for (float& value : ray.origin) value = random.uniform(-2, 10);
        for (float& value : ray.direction) value = random.uniform(-1, 1);
        ray.tMin = 0;
        ray.tMax = random.uniform(0, 20);
    }
    return rays;
}

void expectSame(const BvhioHit& a, const BvhioHit& b) {
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0)
        << a.t << " " << b.t << " " << a.primitive << " " << b.primitive;
}

TEST(Trace, hitsDoNotDependOnBatchesThreadsOrCopies) {
    const Container container = gridContainer(20);
    const Tracer tracer = makeTracer(container.get()), uncopied = makeTracer(container.get(), BVHIO_NO_COPY);
    const std::vector<BvhioRay> rays = randomRays(5000);
    std::vector<BvhioHit> hits(rays.size());
    std::vector<uint32_t> primitives(rays.size());
    ASSERT_EQ(bvhioTraceClosest(tracer.get(), rays.data(), rays.size(), hits.data(), primitives.data(), 0),
              BVHIO_OK);
    size_t found = 0;
    for (const BvhioHit& hit : hits) found += hit.geometry != BVHIO_NOTHING;
    EXPECT_GT(found, 500u);
    EXPECT_LT(found, 4500u);

    for (const BvhioTracer* other : {tracer.get(), uncopied.get()})
        for (const uint32_t threads : {0u, 1u, 2u}) {
            std::vector<BvhioHit> again(rays.size());
            std::vector<uint8_t> occluded(rays.size(), 7);
            ASSERT_EQ(bvhioTraceClosest(other, rays.data(), rays.size(), again.data(), nullptr, threads),
                      BVHIO_OK);
            ASSERT_EQ(bvhioTraceAny(other, rays.data(), rays.size(), occluded.data(), threads), BVHIO_OK);
            for (size_t i = 0; i < rays.size(); ++i) {
                expectSame(hits[i], again[i]);
                EXPECT_EQ(occluded[i], hits[i].geometry != BVHIO_NOTHING ? 1 : 0);
            }
        }
    for (size_t i = 0; i < 500; ++i) {
        BvhioHit hit;
        uint32_t primitive = 0;
        const bool isHit = hits[i].geometry != BVHIO_NOTHING;
        EXPECT_EQ(bvhioTraceRay(tracer.get(), &rays[i], &hit, &primitive), isHit ? 1 : 0);
        EXPECT_EQ(bvhioTraceRay(tracer.get(), &rays[i], nullptr, nullptr), isHit ? 1 : 0);
        EXPECT_EQ(bvhioIsOccluded(tracer.get(), &rays[i]), isHit ? 1 : 0);
        expectSame(hit, hits[i]);
        EXPECT_EQ(primitive, primitives[i]);
        if (!isHit) {
            EXPECT_EQ(primitive, BVHIO_NOTHING);
            EXPECT_EQ(hit.instance, BVHIO_NOTHING);
            EXPECT_TRUE(std::isinf(hit.t));
        }
    }
}

// The point of a hit lies on the triangle that its number stands for.
TEST(Trace, hitsLieOnTheirTriangles) {
    const Container instanced = build(instancedScene().get());
    const Tracer tracer = makeTracer(instanced.get());
    for (const float x : {0.3f, 2.6f, 100.3f, 103.9f}) {
        const BvhioRay ray = rayDown(x, 1.2f);
        BvhioHit hit;
        uint32_t number = 0;
        ASSERT_EQ(bvhioTraceRay(tracer.get(), &ray, &hit, &number), 1);
        BvhioPrimitive primitive;
        ASSERT_EQ(bvhioGetPrimitive(instanced.get(), number, &primitive), BVHIO_OK);
        EXPECT_EQ(primitive.geometry, hit.geometry);
        EXPECT_EQ(primitive.sourceId, hit.primitive);
        EXPECT_EQ(primitive.instance, hit.instance);
        EXPECT_EQ(hit.instance, x > 50 ? 1u : 0u);
        for (int axis = 0; axis < 3; ++axis) {
            const float on = (1 - hit.u - hit.v) * primitive.corners[0][axis] +
                             hit.u * primitive.corners[1][axis] + hit.v * primitive.corners[2][axis];
            EXPECT_NEAR(on, ray.origin[axis] + hit.t * ray.direction[axis], 1e-4f);
        }
    }
    const BvhioRay high = rayDown(0.2f, 0.2f, 60);
    BvhioHit hit;
    ASSERT_EQ(bvhioTraceRay(tracer.get(), &high, &hit, nullptr), 1);
    EXPECT_EQ(hit.t, 10);
    EXPECT_EQ(hit.instance, 2u);
}

TEST(Trace, oddRaysHitNothing) {
    const Container container = gridContainer();
    const Tracer tracer = makeTracer(container.get());
    for (const BvhioRay& ray :
         {BvhioRay{{NAN, 1, 9}, 0, {0, 0, -1}, 99}, BvhioRay{{1, 1, 9}, 0, {0, 0, 0}, 99},
          BvhioRay{{1, 1, 9}, 2, {0, 0, -1}, 1}, BvhioRay{{1, 1, 9}, 0, {0, 0, -INFINITY}, 99}})
        EXPECT_EQ(bvhioIsOccluded(tracer.get(), &ray), 0);
}

TEST(Trace, aTracerOutlivesItsContainer) {
    Container container = gridContainer();
    const Tracer tracer = makeTracer(container.get());
    container.reset();
    const BvhioRay ray = rayDown(1.3f, 1.2f);
    EXPECT_EQ(bvhioIsOccluded(tracer.get(), &ray), 1);
}

TEST(Trace, refusesWhatMakesNoSense) {
    const Container container = gridContainer();
    const Tracer tracer = makeTracer(container.get());
    BvhioTracer* made = nullptr;
    EXPECT_EQ(bvhioCreateTracer(nullptr, 0, nullptr, &made), BVHIO_USAGE);
    EXPECT_EQ(bvhioCreateTracer(container.get(), 0, nullptr, nullptr), BVHIO_USAGE);
    EXPECT_EQ(bvhioCreateTracer(container.get(), 8, nullptr, &made), BVHIO_USAGE);
    EXPECT_EQ(made, nullptr);
    const BvhioRay ray = rayDown(1, 1);
    BvhioHit hit;
    uint8_t occluded = 0;
    EXPECT_EQ(bvhioTraceClosest(nullptr, &ray, 1, &hit, nullptr, 0), BVHIO_USAGE);
    EXPECT_EQ(bvhioTraceClosest(tracer.get(), nullptr, 1, &hit, nullptr, 0), BVHIO_USAGE);
    EXPECT_EQ(bvhioTraceClosest(tracer.get(), &ray, 1, nullptr, nullptr, 0), BVHIO_USAGE);
    EXPECT_EQ(bvhioTraceAny(nullptr, &ray, 1, &occluded, 0), BVHIO_USAGE);
    EXPECT_EQ(bvhioTraceAny(tracer.get(), nullptr, 1, &occluded, 0), BVHIO_USAGE);
    EXPECT_EQ(bvhioTraceAny(tracer.get(), &ray, 1, nullptr, 0), BVHIO_USAGE);
    EXPECT_EQ(bvhioTraceClosest(tracer.get(), nullptr, 0, nullptr, nullptr, 0), BVHIO_OK);
    EXPECT_EQ(bvhioTraceAny(tracer.get(), nullptr, 0, nullptr, 0), BVHIO_OK);
    bvhioDestroyTracer(nullptr);
}

}  // namespace
}  // namespace apitest
