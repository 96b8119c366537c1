// The table of ray sets: what bvh-trace --rays can shoot. Each set is the same to the bit on every machine
// and for any number of threads: it uses only + - * / and sqrt, and each ray has a random stream of its own.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/choice.h"
#include "core/ray.h"
#include "rays/camera.h"
#include "scene/scene.h"

namespace bvhio {

/// Answers closest-hit queries: one Hit per ray, in order. Ray sets that start at surfaces ask it; how it
/// traces is its matter.
using ClosestHits = std::function<std::vector<Hit>(std::span<const Ray>)>;

/// Width and height of a picture in pixels.
struct Resolution {
    uint32_t width = 1024, height = 768;
    bool operator==(const Resolution&) const = default;
};

/// More rays than this, 8 GiB of them, are refused.
inline constexpr uint64_t kMaxRays = uint64_t(1) << 28;

/// Reads "WxH", as in 1920x1080. Throws Error{usage}.
Resolution parseResolution(std::string_view text);

struct RaySetOptions {
    Resolution resolution{};
    /// When not 0, the most rays wanted: `random` makes exactly so many, the others take the largest picture
    /// of about 4:3 that cannot make more (pixels that see nothing make none), and `resolution` is not looked
    /// at.
    uint64_t count = 0;
    uint64_t seed = 1;
    std::optional<Camera> camera{};  // found from the scene (see find_camera.h) when not given
};

/// Rays, and where they come from.
struct RaySet {
    std::vector<Ray> rays;
    /// The pixel of each ray, y * width + x, in the picture that it belongs to. Empty for `random`.
    std::vector<uint32_t> pixels;
    Resolution resolution;
    Camera camera;
    bool anyHitIsEnough = false;  // shadow and ao rays ask only whether something is in the way
};

/// What a row's function works from: everything is settled but the rays.
struct RaySetSource {
    const Scene& scene;
    Aabb bounds;
    Camera camera;
    RaySetOptions options;
    const ClosestHits& closestHits;
};

using RaySetChoice = Choice<RaySet (*)(const RaySetSource&)>;

/// All ray sets, the default first:
/// - primary: one ray through the centre of each pixel, rows from the top, tMin 0 and tMax infinity.
/// - shadow: from each primary hit to a point light (see `lightPosition`); tMax ends just before it.
/// - ao: kAoRays rays from each primary hit, cosine-weighted over the hemisphere, as long as kAoReach of the
///   scene's diagonal.
/// - diffuse: one cosine-weighted bounce off each primary hit, of any length.
/// - random: lines through the scene's bounding box, uniform among all lines that meet it; each starts
///   outside the box, or on it in scenes so large that floats reach no farther.
///
/// Directions have unit length. Rays that leave a surface start on its side that faces the viewer, 2^-19 of
/// the hit triangle's largest coordinate above it: relative, so that nothing is lost in scenes of any size,
/// and large against the few 2^-24 by which rounding may move a point; tMin is 0.
std::span<const RaySetChoice> raySets();

inline constexpr uint32_t kAoRays = 4;
inline constexpr double kAoReach = 0.1;

/// Makes a set; finds the camera if none is given. Throws Error{usage} for an unknown name, a bad camera or
/// too many rays.
RaySet makeRaySet(std::string_view name, const Scene& scene, const RaySetOptions& options,
                  const ClosestHits& closestHits);

/// Where the light of the shadow set is. For an eye outside the scene's bounds: above and to the left of the
/// eye, one diagonal away from the centre. For one inside: above the middle of the free way ahead, three
/// quarters of the way up to what is there.
Vec3 lightPosition(const RaySetSource& source);

}  // namespace bvhio
