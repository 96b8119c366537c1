#include "pictures/heat_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bvhio {
namespace {

/// Returns the relative luminance of an sRGB colour (IEC 61966-2-1).
double luminance(Rgb color) {
    double linear[3];
    for (int i = 0; i < 3; ++i) {
        const double c = color[i] / 255.0;
        linear[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    }
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
}

// Without a steady rise, as in a rainbow, an expensive pixel could look darker than a cheap one.
TEST(HeatMap, getsLighterAllTheWay) {
    for (int i = 0; i < 200; ++i)
        EXPECT_LE(luminance(heatColor(i / 200.0)), luminance(heatColor((i + 1) / 200.0)) + 1e-9) << i;
    EXPECT_LT(luminance(heatColor(0)), 0.01);
    EXPECT_GT(luminance(heatColor(1)), 0.9);
}

// Equal steps of cost are equal steps of lightness (the cube root of luminance).
TEST(HeatMap, isEvenToTheEye) {
    for (int i = 2; i < 16; ++i) {
        const double step =
            std::cbrt(luminance(heatColor((i + 1) / 16.0))) - std::cbrt(luminance(heatColor(i / 16.0)));
        EXPECT_NEAR(step, 1.0 / 16, 0.03) << i;
    }
}

TEST(HeatMap, clampsWhatIsOutside) {
    EXPECT_EQ(heatColor(-1), heatColor(0));
    EXPECT_EQ(heatColor(7), heatColor(1));
}

TEST(HeatMap, whiteIsARoundNumberThatFewExceed) {
    EXPECT_EQ(whiteCost({}), 4u);
    EXPECT_EQ(whiteCost(std::vector<float>(5, 0)), 4u);
    std::vector<float> costs(1000, 90);
    EXPECT_EQ(whiteCost(costs), 100u);
    for (int i = 0; i < 4; ++i) costs[size_t(i)] = 1e6;  // four in a thousand do not darken the rest
    EXPECT_EQ(whiteCost(costs), 100u);
    costs.resize(9000, 0);  // nor do pixels without a ray
    EXPECT_EQ(whiteCost(costs), 100u);
    EXPECT_EQ(whiteCost(std::vector<float>(1, 101)), 120u);
    EXPECT_EQ(whiteCost(std::vector<float>(1, 1e30f)), 4000000000u);
}

TEST(HeatMap, showsEachPixelAboveALegend) {
    std::vector<float> costs(300 * 20, 0);
    costs[300 * 3 + 7] = 50;
    costs[300 * 4 + 8] = 100;
    const Image image = heatMap(costs, {300, 20}, 100);
    EXPECT_EQ(image.width, 300u);
    EXPECT_EQ(image.height, 20 + legendHeight(300));
    EXPECT_EQ(image.at(0, 0), heatColor(0));
    EXPECT_EQ(image.at(7, 3), heatColor(0.5));
    EXPECT_EQ(image.at(8, 4), heatColor(1));
    int inked = 0, white = 0;
    for (uint32_t y = 20; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) {
            inked += image.at(x, y) == Rgb{220, 220, 220};
            white += image.at(x, y) == heatColor(1);
        }
    EXPECT_GT(inked, 100);
    EXPECT_GT(white, 0);
}

TEST(HeatMap, drawsPicturesOfAnyWidth) {
    for (uint32_t width = 1; width < 400; width += 3)
        EXPECT_EQ(heatMap(std::vector<float>(width, 4000000), {width, 1}).height, 1 + legendHeight(width));
}

TEST(HeatMap, averagesThePixelsRays) {
    RaySet set;
    set.resolution = {2, 2};
    set.pixels = {1, 1, 3};
    EXPECT_EQ(costPerPixel(set, std::vector<uint32_t>{10, 20, 7}), (std::vector<float>{0, 15, 0, 7}));
}

}  // namespace
}  // namespace bvhio
