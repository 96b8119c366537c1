#include "rays/camera.h"

#include <charconv>
#include <vector>

#include "core/error.h"
#include "core/split.h"

namespace bvhio {
namespace {

std::string quoted(std::string_view text) {
    return std::string("'").append(text).append("'");
}

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
    throw Error(ErrorKind::usage, "camera " + quoted(text) + ": " + why +
                                      ": use EYE:TARGET[:FOV[:UP]], as in 0,1,5:0,1,0:60:0,1,0");
}

float parseNumber(std::string_view whole, std::string_view text) {
    float value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        refuse(whole, quoted(text) + " is not a finite number");
    return value;
}

Vec3 parsePoint(std::string_view whole, std::string_view what, std::string_view text) {
    const auto parts = split(text, ',');
    if (parts.size() != 3) refuse(whole, std::string(what) + " " + quoted(text) + " is not three numbers");
    return {parseNumber(whole, parts[0]), parseNumber(whole, parts[1]), parseNumber(whole, parts[2])};
}

/// Returns what is wrong with a camera; "" if nothing is.
std::string findFault(const Camera& c) {
    if (!isFinite(c.eye) || !isFinite(c.target) || !isFinite(c.up)) return "a coordinate is not finite";
    if (!(c.fov >= 0.01f && c.fov <= 175)) return "the angle must be from 0.01 to 175 degrees";
    const Vec3d forward = normalize(Vec3d(c.target) - Vec3d(c.eye));
    if (length(forward) == 0) return "eye and target are the same point";
    if (length(cross(forward, normalize(Vec3d(c.up)))) < 1e-6) return "up is zero or parallel to the view";
    return {};
}

void append(std::string& text, float value) {
    char digits[32];  // the shortest text of a float has at most 15 characters
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void append(std::string& text, Vec3 p) {
    append(text, p.x);
    append(text += ',', p.y);
    append(text += ',', p.z);
}

}  // namespace

Camera parseCamera(std::string_view text) {
    const auto parts = split(text, ':');
    if (parts.size() < 2 || parts.size() > 4)
        refuse(text, "it has " + std::to_string(parts.size()) + (parts.size() == 1 ? " part" : " parts"));
    Camera camera;
    camera.eye = parsePoint(text, "the eye", parts[0]);
    camera.target = parsePoint(text, "the target", parts[1]);
    if (parts.size() > 2) camera.fov = parseNumber(text, parts[2]);
    if (parts.size() > 3)
        camera.up = parsePoint(text, "up", parts[3]);
    else if (camera.eye.x == camera.target.x && camera.eye.z == camera.target.z)
        camera.up = {0, 0, -1};
    if (const std::string why = findFault(camera); !why.empty()) refuse(text, why);
    return camera;
}

std::string formatCamera(const Camera& camera) {
    std::string text;
    append(text, camera.eye);
    append(text += ':', camera.target);
    append(text += ':', camera.fov);
    append(text += ':', camera.up);
    return text;
}

CameraFrame cameraFrame(const Camera& camera) {
    if (const std::string why = findFault(camera); !why.empty()) refuse(formatCamera(camera), why);
    const Vec3d forward = normalize(Vec3d(camera.target) - Vec3d(camera.eye));
    const Vec3d right = normalize(cross(forward, normalize(Vec3d(camera.up))));
    return {right, cross(right, forward), forward};
}

double halfTangent(double degrees) {
    constexpr double pi = 3.14159265358979323846;
    const double x = degrees * (pi / 360);
    // The Taylor series of sine and cosine up to x^27 are exact to a few units in the last place for x <= pi
    // / 2.
    double sine = 0, cosine = 0, term = 1;
    for (int n = 0; n < 28; n += 2) {
        cosine += term;
        term *= x / (n + 1);
        sine += term;
        term *= -x / (n + 2);
    }
    return sine / cosine;
}

PrimaryRays::PrimaryRays(const Camera& camera, uint32_t width, uint32_t height) : eye_(camera.eye) {
    const CameraFrame frame = cameraFrame(camera);
    const double pixel = 2 * halfTangent(camera.fov) / height;  // pixels are square, on a plane at distance 1
    stepRight_ = frame.right * pixel;
    stepDown_ = frame.up * -pixel;
    topLeft_ = frame.forward - stepRight_ * (0.5 * (width - 1.0)) - stepDown_ * (0.5 * (height - 1.0));
}

Ray PrimaryRays::ray(uint32_t x, uint32_t y) const {
    Ray ray;
    ray.origin = eye_;
    ray.direction = Vec3(normalize(topLeft_ + stepRight_ * x + stepDown_ * y));
    return ray;
}

}  // namespace bvhio
