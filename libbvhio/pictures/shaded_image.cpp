#include "pictures/shaded_image.h"

#include <algorithm>

#include "core/parallel.h"
#include "rays/sampling.h"
#include "rays/surface_point.h"

namespace bvhio {
namespace {

constexpr uint32_t kSide = 2;            // a pixel is the mean of kSide x kSide points
constexpr uint32_t kAmbientRays = 4;     // from each point
constexpr size_t kBandPoints = 1 << 18;  // traced at a time
constexpr size_t kPixelsPerTask = 4096;

/// Returns a muted colour for each geometry, by steps of the golden ratio round the hues. A scene of one
/// geometry has the colour of clay.
Vec3d colorOf(const Scene& scene, uint32_t primitive) {
    if (scene.placedGeometryCount() == 1) return {0.60, 0.52, 0.44};
    const double turns = scene.primitiveId(primitive).geometry * 0.6180339887498949;
    const double hue = 6 * (turns - double(int64_t(turns)));
    const auto channel = [&](double at) {
        double distance = std::fabs(hue - at);
        distance = std::min(distance, 6 - distance);
        return 0.38 + 0.24 * std::clamp(2 - distance, 0.0, 1.0);
    };
    return {channel(0), channel(2), channel(4)};
}

/// Returns the colour of the sky, which is paler towards the horizon. `down` is 0 at the top of the picture.
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

/// Rows of points that are traced together, and the points that hit something.
struct Band {
    uint32_t width, top;
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<size_t> seen;
};

/// Returns four cosine-weighted directions at the same height above the surface, a quarter turn apart. The
/// points of a pixel divide the heights among them, so that the sixteen rays of a pixel cover the hemisphere
/// evenly, with much less noise than sixteen random rays.
std::array<Vec3d, kAmbientRays> ambientDirections(Vec3d normal, uint32_t share, Random& random) {
    // The squared sine of the angle to the normal.
    const double squared = (share + double(random.uniform())) / (kSide * kSide);
    Vec3d across;
    do across = cross(normal, cosineDirection(normal, random));
    while (dot(across, across) < 1e-12);
    across = normalize(across) * std::sqrt(squared);
    const Vec3d along = cross(normal, across), up = normal * std::sqrt(1 - squared);
    return {up + across, up + along, up - across, up - along};
}

/// Returns how open to the sky each of the band's hits is, from 0 to 1. Distant surfaces darken less, so that
/// corners look soft.
std::vector<double> openness(const Scene& scene, const Band& band, float reach,
                             const ClosestHits& closestHits) {
    std::vector<Ray> ambient(band.seen.size() * kAmbientRays);
    parallelChunks(band.seen.size(), kPixelsPerTask, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const size_t at = band.seen[i], x = at % band.width, y = band.top + at / band.width;
            const SurfacePoint point = surfacePoint(scene, band.rays[at], band.hits[at]);
            Random random = randomStream(1, y * band.width + x);
            const auto share = uint32_t(y % kSide * kSide + x % kSide);
            const auto directions = ambientDirections(point.normal, share, random);
            for (uint32_t k = 0; k < kAmbientRays; ++k)
                ambient[i * kAmbientRays + k] = {point.origin, 0, Vec3(directions[k]), reach};
        }
    });
    const std::vector<Hit> blocked = closestHits(ambient);
    std::vector<double> open(band.seen.size(), 0.0);
    for (size_t i = 0; i < blocked.size(); ++i)
        open[i / kAmbientRays] += (blocked[i].isMiss() ? 1 : double(blocked[i].t) / reach) / kAmbientRays;
    return open;
}

/// Returns the light that each point of a band sends to the eye.
std::vector<Vec3d> bandLight(const Scene& scene, const PrimaryRays& make, const CameraFrame& frame,
                             float reach, uint32_t width, uint32_t height, uint32_t top, uint32_t rows,
                             const ClosestHits& closestHits) {
    Band band{width, top, std::vector<Ray>(size_t(rows) * width), {}, {}};
    std::vector<Vec3d> light(band.rays.size());
    for (size_t i = 0; i < band.rays.size(); ++i) {
        const uint32_t y = top + uint32_t(i / width);
        band.rays[i] = make.ray(uint32_t(i % width), y);
        light[i] = background(double(y) / height);
    }
    band.hits = closestHits(band.rays);
    for (size_t i = 0; i < band.hits.size(); ++i)
        if (!band.hits[i].isMiss()) band.seen.push_back(i);
    const std::vector<double> open = openness(scene, band, reach, closestHits);
    parallelChunks(band.seen.size(), kPixelsPerTask, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const size_t at = band.seen[i];
            light[at] = shade(scene, band.rays[at], band.hits[at], frame, open[i]);
        }
    });
    return light;
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
        const auto light = bandLight(scene, make, frame, reach, width, height, top, rows, closestHits);
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
