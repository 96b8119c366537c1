// The table of ray sets, from which bvh-trace --rays chooses. Each set has the same bits on every machine and
// for any number of threads: it uses only + - * / and sqrt, and each ray has its own random stream.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/choice.h"
#include "core/ray.h"
#include "rays/camera.h"
#include "scene/scene.h"

namespace bvhio {

/// A function that answers closest-hit queries, one Hit per ray, in order. Ray sets that start at surfaces
/// call it; it may trace in any way.
using ClosestHits = std::function<std::vector<Hit>(std::span<const Ray>)>;

/// Width and height of a picture in pixels.
struct Resolution {
    uint32_t width = 1024, height = 768;
    bool operator==(const Resolution&) const = default;
};

/// The most rays of a set, which take 8 GiB.
inline constexpr uint64_t kMaxRays = uint64_t(1) << 28;

/// Parses "WxH", as in 1920x1080. Throws Error{usage}.
Resolution parseResolution(std::string_view text);

/// The text that parseResolution reads back.
std::string formatResolution(const Resolution& resolution);

struct RaySetOptions {
    Resolution resolution{};
    /// If not 0, the most rays to make, and `resolution` is ignored. `random` makes exactly that many. The
    /// others use the largest picture of about 4:3 that cannot make more; pixels that see nothing make none.
    uint64_t count = 0;
    uint64_t seed = 1;
    std::optional<Camera> camera{};  // if not given, it is found from the scene (see find_camera.h)
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

/// The input of a row's function, with all defaults filled in.
struct RaySetSource {
    const Scene& scene;
    Aabb bounds;
    Camera camera;
    RaySetOptions options;
    const ClosestHits& closestHits;
};

using RaySetChoice = Choice<RaySet (*)(const RaySetSource&)>;

/// Returns all ray sets, the default first:
/// - primary: one ray through the centre of each pixel, rows from the top, tMin 0 and tMax infinity.
/// - shadow: from each primary hit to a point light (see `lightPosition`); tMax ends just before it.
/// - ao: kAoRays rays from each primary hit, cosine-weighted over the hemisphere, as long as kAoReach of the
///   scene's diagonal.
/// - diffuse: one cosine-weighted bounce off each primary hit, of any length.
/// - random: lines through the scene's bounding box, uniform among all lines that meet it; each starts
///   outside the box, or on it in scenes so large that floats reach no farther.
///
/// Directions have unit length. Rays that leave a surface start on the side that faces the viewer, above the
/// surface by 2^-19 of the hit triangle's largest coordinate. This distance is relative, so that scenes of
/// any size work, and large compared with the few 2^-24 by which rounding may move a point. tMin is 0.
std::span<const RaySetChoice> raySets();

inline constexpr uint32_t kAoRays = 4;
inline constexpr double kAoReach = 0.1;

/// Makes a ray set, and finds a camera if none is given. Throws Error{usage} for an unknown name, an invalid
/// camera or too many rays.
RaySet makeRaySet(std::string_view name, const Scene& scene, const RaySetOptions& options,
                  const ClosestHits& closestHits);

/// Returns the position of the light of the shadow set. If the eye is outside the scene's bounds, the light
/// is above and to the left of the eye, one diagonal away from the centre. If the eye is inside, the light is
/// above the middle of the free way ahead, three quarters of the way up to the next surface.
Vec3 lightPosition(const RaySetSource& source);

}  // namespace bvhio
