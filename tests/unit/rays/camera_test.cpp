#include "rays/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace bvhio {
namespace {

std::string messageOf(const std::string& text) {
    try {
        parseCamera(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        return error.what();
    }
    return "accepted";
}

TEST(Camera, saysWhatIsWrong) {
    const std::pair<const char*, const char*> cases[] = {
        {"", "it has 1 part:"},
        {"1,2,3", "it has 1 part:"},
        {"1,2,3:4,5", "the target '4,5' is not three numbers"},
        {"1,2,3,4:4,5,6", "the eye '1,2,3,4' is not three numbers"},
        {"1,2,x:4,5,6", "'x' is not a finite number"},
        {"1,2, 3:4,5,6", "' 3' is not a finite number"},
        {"1,2,nan:4,5,6", "'nan' is not a finite number"},
        {"1,2,1e99:4,5,6", "'1e99' is not a finite number"},
        {"1,2,3:4,5,6:", "'' is not a finite number"},
        {"1,2,3:4,5,6:180", "the angle must be from 0.01 to 175 degrees"},
        {"1,2,3:4,5,6:0", "the angle must be from 0.01 to 175 degrees"},
        {"1,2,3:1,2,3", "eye and target are the same point"},
        {"0,0,0:0,0,5:60:0,0,2", "up is zero or parallel to the view"},
        {"0,0,0:0,0,5:60:0,0,0", "up is zero or parallel to the view"},
        {"0,0,0:0,0,5:60:0,1,0:", "it has 5 parts"},
    };
    for (const auto& [text, why] : cases) {
        const std::string message = messageOf(text);
        EXPECT_NE(message.find(why), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
    }
}

TEST(Camera, readsEveryPart) {
    const Camera camera = parseCamera("1,-2.5,3e2:4,5,6:60:0,0,1");
    EXPECT_EQ(camera, (Camera{{1, -2.5f, 300}, {4, 5, 6}, 60, {0, 0, 1}}));
    EXPECT_EQ(parseCamera("0,0,0:1,0,0"), (Camera{{0, 0, 0}, {1, 0, 0}}));
    EXPECT_EQ(parseCamera("0,9,0:0,0,0").up, (Vec3{0, 0, -1}));
}

TEST(Camera, writesWhatItReads) {
    const Camera camera{{0.1f, 1e-30f, -3e20f}, {1.0f / 3, 0, 7}, 47.3f, {0.2f, 1, 0}};
    EXPECT_EQ(parseCamera(formatCamera(camera)), camera);
    EXPECT_EQ(formatCamera({{0, 1, 5}, {0, 1, 0}, 60, {0, 1, 0}}), "0,1,5:0,1,0:60:0,1,0");
}

TEST(Camera, tangentIsThatOfTheMathsLibrary) {
    for (double degrees = 0.01; degrees < 175; degrees += 0.37) {
        const double expected = std::tan(degrees * (3.14159265358979323846 / 360));
        EXPECT_NEAR(halfTangent(degrees) / expected, 1, 1e-13) << degrees;
    }
}

// Fails if the picture is mirrored, upside down, or shifted by half a pixel.
TEST(Camera, raysGoThroughPixelCentres) {
    const Camera camera{{0, 0, 5}, {0, 0, 0}, 90, {0, 1, 0}};
    const PrimaryRays rays(camera, 4, 2);
    const auto expectAlong = [&](uint32_t x, uint32_t y, double dx, double dy) {
        const Vec3d expected = normalize(Vec3d{dx, dy, -1});
        const Ray ray = rays.ray(x, y);
        EXPECT_EQ(ray.origin, camera.eye);
        EXPECT_EQ(ray.tMin, 0);
        EXPECT_EQ(ray.tMax, std::numeric_limits<float>::infinity());
        EXPECT_NEAR(ray.direction.x, expected.x, 1e-6);
        EXPECT_NEAR(ray.direction.y, expected.y, 1e-6);
        EXPECT_NEAR(ray.direction.z, expected.z, 1e-6);
    };
    expectAlong(0, 0, -1.5, 0.5);
    expectAlong(3, 0, 1.5, 0.5);
    expectAlong(2, 1, 0.5, -0.5);
}

TEST(Camera, raysStayUnitForTinyAndHugeScenes) {
    for (const float scale : {1e-30f, 1.0f, 1e30f}) {
        const PrimaryRays rays({{0, scale, 3 * scale}, {0, 0, scale}}, 64, 48);
        for (uint32_t y = 0; y < 48; y += 47)
            for (uint32_t x = 0; x < 64; x += 63)
                EXPECT_NEAR(length(Vec3d(rays.ray(x, y).direction)), 1, 1e-6);
    }
}

}  // namespace
}  // namespace bvhio
