#include "rays/ray_sets.h"

#include <algorithm>
#include <charconv>

#include "core/parallel.h"
#include "rays/find_camera.h"
#include "rays/sampling.h"
#include "rays/surface_point.h"

namespace bvhio {
namespace {

constexpr size_t kGrain = 4096;  // rays per task

Error tooMany(uint64_t rays) {
    return {ErrorKind::usage, std::to_string(rays) + " rays are too many: at most " +
                                  std::to_string(kMaxRays) + " are allowed"};
}

/// Returns the picture whose pixels make at most options.count rays, or the requested picture if count is 0.
Resolution pictureOf(const RaySetOptions& options, uint64_t raysPerPixel) {
    Resolution r = options.resolution;
    if (options.count > 0) {
        const uint64_t pixels = options.count / raysPerPixel;
        if (pixels > kMaxRays) throw tooMany(options.count);
        r.width = uint32_t(std::sqrt(double(pixels) * 4 / 3));
        if (r.width > 0) r.height = uint32_t(pixels / r.width);
        if (r.width == 0)
            throw Error(ErrorKind::usage, "count " + std::to_string(options.count) +
                                              " is too small: each hit makes " +
                                              std::to_string(raysPerPixel) + " rays");
    }
    if (uint64_t(r.width) * r.height > kMaxRays / raysPerPixel)
        throw tooMany(uint64_t(r.width) * r.height * raysPerPixel);
    return r;
}

RaySet primary(const RaySetSource& source, Resolution resolution) {
    RaySet set;
    set.camera = source.camera;
    set.resolution = resolution;
    const size_t count = size_t(resolution.width) * resolution.height;
    set.rays.resize(count);
    set.pixels.resize(count);
    const PrimaryRays make(source.camera, resolution.width, resolution.height);
    parallelChunks(count, kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            set.rays[i] = make.ray(uint32_t(i % resolution.width), uint32_t(i / resolution.width));
            set.pixels[i] = uint32_t(i);
        }
    });
    return set;
}

RaySet primary(const RaySetSource& source) {
    return primary(source, pictureOf(source.options, 1));
}

/// Makes rays that leave the surfaces seen by the camera. `make` gets a point and the random stream of the
/// ray, and returns the ray.
template <class Make>
RaySet fromSurfaces(const RaySetSource& source, uint32_t raysPerPixel, const Make& make) {
    // Find the surfaces.
    RaySet set = primary(source, pictureOf(source.options, raysPerPixel));
    const std::vector<Hit> hits = source.closestHits(set.rays);
    std::vector<uint32_t> seen;  // pixels that see something
    for (const uint32_t pixel : set.pixels)
        if (!hits[pixel].isMiss()) seen.push_back(pixel);

    // Make the rays of each pixel that sees one.
    const std::vector<Ray> primaryRays = std::move(set.rays);
    set.rays.assign(seen.size() * raysPerPixel, {});
    set.pixels.assign(set.rays.size(), 0);
    parallelChunks(seen.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const uint32_t pixel = seen[i];
            const SurfacePoint point = surfacePoint(source.scene, primaryRays[pixel], hits[pixel]);
            for (uint32_t k = 0; k < raysPerPixel; ++k) {
                const size_t at = i * raysPerPixel + k;
                Random random = randomStream(source.options.seed, uint64_t(pixel) * raysPerPixel + k);
                set.rays[at] = make(point, random);
                set.rays[at].origin = point.origin;
                set.pixels[at] = pixel;
            }
        }
    });
    return set;
}

RaySet shadow(const RaySetSource& source) {
    const Vec3d light(lightPosition(source));
    RaySet set = fromSurfaces(source, 1, [&](const SurfacePoint& point, Random&) {
        const Vec3d way = light - Vec3d(point.origin);
        Ray ray;
        ray.direction = Vec3(normalize(way));
        ray.tMax = float(length(way) * (1 - 0x1p-10));  // ends before the light, which may be on a surface
        return ray;
    });
    set.anyHitIsEnough = true;
    return set;
}

RaySet ao(const RaySetSource& source) {
    const auto reach = float(kAoReach * length(Vec3d(source.bounds.max) - Vec3d(source.bounds.min)));
    RaySet set = fromSurfaces(source, kAoRays, [&](const SurfacePoint& point, Random& random) {
        Ray ray;
        ray.direction = Vec3(cosineDirection(point.normal, random));
        ray.tMax = reach;
        return ray;
    });
    set.anyHitIsEnough = true;
    return set;
}

RaySet diffuse(const RaySetSource& source) {
    return fromSurfaces(source, 1, [](const SurfacePoint& point, Random& random) {
        Ray ray;
        ray.direction = Vec3(cosineDirection(point.normal, random));
        return ray;
    });
}

/// Makes uniform lines through the scene's box. A uniform point on the surface of a convex body with a
/// cosine-weighted direction inwards is a uniform line through the body (Cauchy-Crofton). The ray starts
/// before that point, outside the box, so that it also crosses surfaces in the sides of the box.
RaySet randomLines(const RaySetSource& source) {
    RaySet set;
    set.camera = source.camera;
    set.resolution = source.options.resolution;
    const uint64_t count = source.options.count > 0 ? source.options.count
                                                    : uint64_t(set.resolution.width) * set.resolution.height;
    if (count > kMaxRays) throw tooMany(count);
    set.rays.resize(count);
    const Vec3d low(source.bounds.min), extent = Vec3d(source.bounds.max) - low;
    const double diagonal = length(extent);
    // In very large scenes rays start closer to the box, so that origins and hits stay finite.
    double largest = 0;
    for (const Vec3 corner : {source.bounds.min, source.bounds.max})
        for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::fabs(double(corner[axis])));
    const double back = std::clamp(kLargestFloat - std::max(largest, diagonal), 0.0, diagonal);
    double area[3] = {extent.y * extent.z, extent.z * extent.x, extent.x * extent.y};
    if (area[0] + area[1] + area[2] == 0)
        area[0] = area[1] = area[2] = 1;  // a line or a point: all sides count the same
    parallelChunks(count, kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            Random random = randomStream(source.options.seed, i);
            const double pick = random.uniform() * (area[0] + area[1] + area[2]);
            const int axis = pick < area[0] ? 0 : pick < area[0] + area[1] ? 1 : 2;
            const bool far = random.below(2) == 1;
            double at[3] = {random.uniform(), random.uniform(), random.uniform()}, inwards[3] = {0, 0, 0};
            at[axis] = far ? 1 : 0;
            inwards[axis] = far ? -1 : 1;
            const Vec3d point = low + Vec3d{at[0] * extent.x, at[1] * extent.y, at[2] * extent.z};
            const Vec3d direction = cosineDirection({inwards[0], inwards[1], inwards[2]}, random);
            set.rays[i].origin = clampToFloat(point - direction * back);
            set.rays[i].direction = Vec3(direction);
        }
    });
    return set;
}

constexpr RaySetChoice kRaySets[] = {
    {"primary", "one ray through each pixel of a camera", primary},
    {"shadow", "from the surfaces that the camera sees to a light", shadow},
    {"ao", "short rays over the hemisphere of each visible surface point", ao},
    {"diffuse", "one diffuse bounce off each visible surface point", diffuse},
    {"random", "uniform lines through the scene's box", randomLines},
};

}  // namespace

std::span<const RaySetChoice> raySets() {
    return kRaySets;
}

Resolution parseResolution(std::string_view text) {
    Resolution r{0, 0};
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, r.width);
    bool good = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    if (good) {
        const auto height = std::from_chars(width.ptr + 1, end, r.height);
        good = height.ec == std::errc() && height.ptr == end;
    }
    if (!good || r.width == 0 || r.height == 0 || r.width > 65536 || r.height > 65536)
        throw Error(ErrorKind::usage, "resolution '" + std::string(text) +
                                          "' is not WxH with each from 1 to 65536, as in 1024x768");
    return r;
}

std::string formatResolution(const Resolution& resolution) {
    return std::to_string(resolution.width) + "x" + std::to_string(resolution.height);
}

RaySet makeRaySet(std::string_view name, const Scene& scene, const RaySetOptions& options,
                  const ClosestHits& closestHits) {
    const RaySetChoice& row = choose(raySets(), "ray set", name);
    const Resolution r = options.count > 0 ? Resolution{4, 3} : options.resolution;
    const Camera camera =
        options.camera ? *options.camera : findCamera(scene, double(r.width) / r.height, closestHits);
    return row.function({scene, triangleBounds(scene), camera, options, closestHits});
}

Vec3 lightPosition(const RaySetSource& source) {
    const CameraFrame frame = cameraFrame(source.camera);
    const Vec3d eye(source.camera.eye), center(source.bounds.center());
    const double diagonal = length(Vec3d(source.bounds.max) - Vec3d(source.bounds.min));
    if (!source.bounds.contains({source.camera.eye, source.camera.eye}))
        return clampToFloat(center +
                            normalize(normalize(eye - center) + frame.up - frame.right * 0.5) * diagonal);
    const auto freeWay = [&](Vec3d from, Vec3d direction, double unbounded) {
        Ray ray;
        ray.origin = Vec3(from);
        ray.direction = Vec3(direction);
        const Hit hit = source.closestHits({&ray, 1})[0];
        return hit.isMiss() ? unbounded : double(hit.t);
    };
    const Vec3d middle = eye + frame.forward * (0.5 * freeWay(eye, frame.forward, 0.5 * diagonal));
    const Vec3d up = normalize(Vec3d(source.camera.up));
    return clampToFloat(middle + up * (0.75 * freeWay(middle, up, 0.5 * diagonal)));
}

}  // namespace bvhio
