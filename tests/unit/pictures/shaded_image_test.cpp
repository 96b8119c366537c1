#include "pictures/shaded_image.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "unit/trace/brute_hits.h"

namespace bvhio {
namespace {

const Camera kFourAway{{0, 0, 4}, {0, 0, 0}, 40, {0, 1, 0}};

TEST(ShadedImage, showsTheObjectOnABackground) {
    const Scene ball = makeBall(1, {});
    const Image image = shadedImage(ball, kFourAway, {41, 31}, bruteForce(ball));
    const auto red = [&](uint32_t x, uint32_t y) { return int(image.at(x, y)[0]); };
    const auto blue = [&](uint32_t x, uint32_t y) { return int(image.at(x, y)[2]); };
    EXPECT_GT(red(20, 15), blue(20, 15));  // clay
    EXPECT_LT(red(1, 1), blue(1, 1));      // sky
    EXPECT_GT(red(16, 11), red(25, 21));   // lit from above and the left
    EXPECT_GT(red(25, 21), 40);            // but never black
}

TEST(ShadedImage, givesGeometriesTheirOwnColors) {
    Scene wall = makeScene({{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}, {{0, 1, 2}, {0, 2, 3}});
    wall.geometries = {{"a", 0, 1}, {"b", 1, 1}};
    const Image image = shadedImage(wall, kFourAway, {20, 20}, bruteForce(wall));
    EXPECT_NE(image.at(15, 15), image.at(4, 4));
}

TEST(ShadedImage, isTheSameForAnyNumberOfThreads) {
    const Scene ball = makeBall(1, {});
    const Image image = shadedImage(ball, kFourAway, {90, 60}, bruteForce(ball));
    const ThreadLimit one(1);
    EXPECT_EQ(shadedImage(ball, kFourAway, {90, 60}, bruteForce(ball)).pixels, image.pixels);
}

}  // namespace
}  // namespace bvhio
