// The pinhole camera of primary rays, and its text on the command line.
#pragma once

#include <string>
#include <string_view>

#include "core/ray.h"
#include "rays/vec3d.h"

namespace bvhio {

/// A pinhole camera. `fov` is the full vertical angle in degrees. `up` must not be parallel to the view.
struct Camera {
    Vec3 eye;
    Vec3 target;
    float fov = 50;
    Vec3 up{0, 1, 0};
    bool operator==(const Camera&) const = default;
};

/// Parses "EYE:TARGET[:FOV[:UP]]", with points as x,y,z and the angle in degrees: "0,1,5:0,1,0:60:0,0,1". The
/// default of UP is +y, or -z for a view along y. Throws Error{usage} that says which part is wrong.
Camera parseCamera(std::string_view text);

/// Returns the text from which `parseCamera` gets the same bits.
std::string formatCamera(const Camera& camera);

/// Unit vectors to the right, up and forwards of a camera. cameraFrame throws Error{usage} for an invalid
/// camera.
struct CameraFrame {
    Vec3d right, up, forward;
};
CameraFrame cameraFrame(const Camera& camera);

/// Returns the tangent of half an angle in degrees, between 0 and 180. Uses a series in double, since the
/// results of libm differ between versions.
double halfTangent(double degrees);

/// Makes the rays through the centres of a picture's pixels.
class PrimaryRays {
  public:
    PrimaryRays(const Camera& camera, uint32_t width, uint32_t height);

    /// Returns the ray through column x, from the left, and row y, from the top. Its direction has unit
    /// length.
    Ray ray(uint32_t x, uint32_t y) const;

  private:
    Vec3 eye_;
    Vec3d topLeft_;               // the first pixel's centre as seen from the eye
    Vec3d stepRight_, stepDown_;  // the way from a pixel to the next
};

}  // namespace bvhio
