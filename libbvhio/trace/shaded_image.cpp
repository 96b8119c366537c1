#include "trace/shaded_image.h"

#include <algorithm>

#include "core/parallel.h"
#include "trace/sampling.h"
#include "trace/surface_point.h"

namespace bvhio {
namespace {

constexpr uint32_t kSide = 2;            // a pixel averages kSide x kSide points
constexpr uint32_t kAmbientRays = 4;     // from each of them
constexpr size_t kBandPoints = 1 << 18;  // traced at a time
constexpr size_t kGrain = 4096;

/// A quiet colour for each geometry, by stepping round the hues in the golden ratio; clay where there is only
/// one.
Vec3d colorOf(const Scene& scene, uint32_t triangle) {
    if (scene.geometries.size() == 1) return {0.60, 0.52, 0.44};
    const double turns = scene.primitiveId(triangle).geometry * 0.6180339887498949;
    const double hue = 6 * (turns - double(int64_t(turns)));
    const auto channel = [&](double at) {
        double distance = std::fabs(hue - at);
        distance = std::min(distance, 6 - distance);
        return 0.38 + 0.24 * std::clamp(2 - distance, 0.0, 1.0);
    };
    return {channel(0), channel(2), channel(4)};
}

/// Light from the sky, paler towards the horizon.
Vec3d background(double down) {
    return Vec3d{0.42, 0.52, 0.64} * (1 - down) + Vec3d{0.86, 0.88, 0.90} * down;
}

Vec3d shade(const Scene& scene, const Ray& ray, const Hit& hit, const CameraFrame& frame, double open) {
    const Vec3d normal = surfacePoint(scene, ray, hit).normal;
    const Vec3d lamp = normalize(Vec3d(ray.direction) * -1 + frame.up * 0.35 - frame.right * 0.35);
    const double direct = std::max(0.0, dot(normal, lamp));
    const double sky = 0.8 + 0.2 * dot(normal, frame.up);
    return colorOf(scene, hit.primitive) * (0.85 * direct * (0.4 + 0.6 * open) + 0.55 * sky * open);
}

/// How open to the sky each of the hits is that `seen` lists, 0 to 1. What blocks from afar darkens less, so
/// that corners are soft.
std::vector<double> openness(const Scene& scene, std::span<const Ray> rays, std::span<const Hit> hits,
                             std::span<const size_t> seen, float reach, uint64_t firstStream,
                             const ClosestHits& closestHits) {
    std::vector<Ray> ambient(seen.size() * kAmbientRays);
    parallelChunks(seen.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const SurfacePoint point = surfacePoint(scene, rays[seen[i]], hits[seen[i]]);
            Random random = randomStream(1, firstStream + seen[i]);
            for (uint32_t k = 0; k < kAmbientRays; ++k)
                ambient[i * kAmbientRays + k] = {point.origin, 0, Vec3(cosineDirection(point.normal, random)),
                                                 reach};
        }
    });
    const std::vector<Hit> blocked = closestHits(ambient);
    std::vector<double> open(seen.size(), 0.0);
    for (size_t i = 0; i < blocked.size(); ++i)
        open[i / kAmbientRays] += (blocked[i].isMiss() ? 1 : double(blocked[i].t) / reach) / kAmbientRays;
    return open;
}

}  // namespace

Image shadedImage(const Scene& scene, const Camera& camera, Resolution resolution,
                  const ClosestHits& closestHits) {
    const uint32_t width = resolution.width * kSide, height = resolution.height * kSide;
    const PrimaryRays make(camera, width, height);
    const CameraFrame frame = cameraFrame(camera);
    const Aabb box = triangleBounds(scene);
    const auto reach = float(kAoReach * length(Vec3d(box.max) - Vec3d(box.min)));
    const auto bandRows = uint32_t(std::max<size_t>(1, kBandPoints / width / kSide)) * kSide;
    Image image(resolution.width, resolution.height);
    for (uint32_t top = 0; top < height; top += bandRows) {
        const uint32_t rows = std::min(bandRows, height - top);
        std::vector<Ray> rays(size_t(rows) * width);
        std::vector<Vec3d> light(rays.size());
        for (size_t i = 0; i < rays.size(); ++i) {
            const uint32_t y = top + uint32_t(i / width);
            rays[i] = make.ray(uint32_t(i % width), y);
            light[i] = background(double(y) / height);
        }
        const std::vector<Hit> hits = closestHits(rays);
        std::vector<size_t> seen;
        for (size_t i = 0; i < hits.size(); ++i)
            if (!hits[i].isMiss()) seen.push_back(i);
        const auto open = openness(scene, rays, hits, seen, reach, uint64_t(top) * width, closestHits);
        parallelChunks(seen.size(), kGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i)
                light[seen[i]] = shade(scene, rays[seen[i]], hits[seen[i]], frame, open[i]);
        });
        for (uint32_t y = 0; y < rows / kSide; ++y)
            for (uint32_t x = 0; x < resolution.width; ++x) {
                Vec3d sum;
                for (uint32_t k = 0; k < kSide * kSide; ++k)
                    sum = sum + light[size_t(y * kSide + k / kSide) * width + x * kSide + k % kSide];
                const Vec3d mean = sum * (1.0 / (kSide * kSide));
                image.at(x, top / kSide + y) = fromLinear(mean.x, mean.y, mean.z);
            }
    }
    return image;
}

}  // namespace bvhio
