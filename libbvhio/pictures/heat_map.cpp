#include "pictures/heat_map.h"

#include <algorithm>
#include <string>

namespace bvhio {
namespace {

/// A ramp whose lightness in OKLab (Ottosson 2020) rises linearly. It has the hues of a glowing body, as
/// saturated as sRGB allows.
constexpr Rgb kRamp[] = {{2, 0, 14},      {14, 0, 34},    {35, 0, 51},   {59, 0, 64},    {86, 0, 72},
                         {114, 0, 76},    {143, 2, 74},   {173, 1, 67},  {204, 3, 48},   {228, 42, 0},
                         {233, 91, 1},    {242, 123, 4},  {252, 150, 4}, {252, 180, 70}, {249, 208, 123},
                         {248, 233, 177}, {254, 253, 234}};
constexpr int kRampSteps = int(std::size(kRamp)) - 1;

/// The letters of the legend, of 5 x 7 dots. Each row is a number, whose highest bit is the left dot.
struct Glyph {
    char letter;
    uint8_t rows[7];
};
constexpr int kGlyphWidth = 5, kGlyphHeight = 7;
constexpr Glyph kGlyphs[] = {
    {'0', {14, 17, 19, 21, 25, 17, 14}}, {'1', {4, 12, 4, 4, 4, 4, 14}},
    {'2', {14, 17, 1, 2, 4, 8, 31}},     {'3', {31, 2, 4, 2, 1, 17, 14}},
    {'4', {2, 6, 10, 18, 31, 2, 2}},     {'5', {31, 16, 30, 1, 1, 17, 14}},
    {'6', {6, 8, 16, 30, 17, 17, 14}},   {'7', {31, 1, 2, 4, 8, 8, 8}},
    {'8', {14, 17, 17, 14, 17, 17, 14}}, {'9', {14, 17, 17, 15, 1, 2, 12}},
    {'+', {0, 4, 4, 31, 4, 4, 0}},       {'A', {14, 17, 17, 31, 17, 17, 17}},
    {'B', {30, 17, 17, 30, 17, 17, 30}}, {'D', {28, 18, 17, 17, 17, 18, 28}},
    {'E', {31, 16, 16, 30, 16, 16, 31}}, {'G', {14, 17, 16, 23, 17, 17, 15}},
    {'I', {14, 4, 4, 4, 4, 4, 14}},      {'L', {16, 16, 16, 16, 16, 16, 31}},
    {'N', {17, 17, 25, 21, 19, 17, 17}}, {'O', {14, 17, 17, 17, 17, 17, 14}},
    {'P', {30, 17, 17, 30, 16, 16, 16}}, {'R', {30, 17, 17, 30, 20, 18, 17}},
    {'S', {15, 16, 16, 14, 1, 1, 30}},   {'T', {31, 4, 4, 4, 4, 4, 4}},
    {'X', {17, 17, 10, 4, 10, 17, 17}},  {'Y', {17, 17, 17, 10, 4, 4, 4}},
};
constexpr std::string_view kTitle = "BOX AND TRIANGLE TESTS PER RAY";
constexpr Rgb kPaper{24, 24, 28}, kInk{220, 220, 220};

/// Returns the width and height in pixels of a glyph's dot in a picture of this width.
uint32_t dotSize(uint32_t width) {
    return std::clamp(width / 360u, 1u, 8u);
}

uint32_t textWidth(std::string_view text, uint32_t dot) {
    return uint32_t(text.size()) * (kGlyphWidth + 1) * dot - dot;
}

/// Draws text with its top left corner at (x, y). Parts outside the picture are left out.
void drawText(Image& image, std::string_view text, int64_t x, int64_t y, uint32_t dot) {
    for (const char letter : text) {
        for (const Glyph& glyph : kGlyphs) {
            if (glyph.letter != letter) continue;
            for (int64_t py = 0; py < kGlyphHeight * dot; ++py)
                for (int64_t px = 0; px < kGlyphWidth * dot; ++px) {
                    const bool inked = glyph.rows[py / dot] >> (kGlyphWidth - 1 - px / dot) & 1;
                    if (inked && x + px >= 0 && x + px < image.width && y + py < image.height)
                        image.at(uint32_t(x + px), uint32_t(y + py)) = kInk;
                }
        }
        x += (kGlyphWidth + 1) * dot;
    }
}

/// Draws the bar of colours with five numbers below it, and the title if it fits.
void drawLegend(Image& image, uint32_t top, uint32_t white) {
    const uint32_t dot = dotSize(image.width), margin = 6 * dot, barTop = top + 4 * dot,
                   barEnd = barTop + 7 * dot;
    if (image.width <= 2 * margin + 1) return;
    const uint32_t barWidth = image.width - 2 * margin;
    for (uint32_t y = top; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) {
            const bool bar = y >= barTop && y < barEnd && x >= margin && x < margin + barWidth;
            image.at(x, y) = bar ? heatColor(double(x - margin) / (barWidth - 1)) : kPaper;
        }
    const bool titled = 2 * textWidth(kTitle, dot) < barWidth;
    for (uint32_t i = 0; i <= 4; ++i) {
        const std::string number = std::to_string(uint64_t(white) * i / 4) + (i == 4 ? "+" : "");
        const int64_t length = textWidth(number, dot), at = margin + int64_t(barWidth) * i / 4;
        const int64_t x = i == 0 ? at : i == 4 ? at - length : at - length / 2;
        if (i == 0 || i == 4 || barWidth > 6 * textWidth(number, dot))
            drawText(image, number, x, barEnd + 2 * dot, dot);
    }
    if (titled) drawText(image, kTitle, (image.width - textWidth(kTitle, dot)) / 2, barEnd + 12 * dot, dot);
}

}  // namespace

Rgb heatColor(double share) {
    const double at = std::clamp(share, 0.0, 1.0) * kRampSteps;
    const int step = std::min(int(at), kRampSteps - 1);
    Rgb color;
    for (int i = 0; i < 3; ++i) {
        const double a = kRamp[step][i], b = kRamp[step + 1][i];
        color[i] = uint8_t(a + (b - a) * (at - step) + 0.5);
    }
    return color;
}

std::vector<float> costPerPixel(const RaySet& set, std::span<const uint32_t> costs) {
    const size_t pixels = size_t(set.resolution.width) * set.resolution.height;
    std::vector<uint64_t> sums(pixels);
    std::vector<uint32_t> rays(pixels);
    for (size_t i = 0; i < set.pixels.size(); ++i) {
        sums[set.pixels[i]] += costs[i];
        ++rays[set.pixels[i]];
    }
    std::vector<float> means(pixels);
    for (size_t i = 0; i < pixels; ++i)
        if (rays[i] > 0) means[i] = float(double(sums[i]) / rays[i]);
    return means;
}

uint32_t whiteCost(std::span<const float> costs) {
    std::vector<float> some;
    for (const float cost : costs)
        if (cost > 0) some.push_back(cost);
    if (some.empty()) return 4;
    const auto high = some.begin() + ptrdiff_t(double(some.size() - 1) * 0.995);
    std::nth_element(some.begin(), high, some.end());
    // Four steps of a round number, so that the five numbers of the legend are round.
    for (uint64_t ten = 1; ten < 1000000000; ten *= 10)
        for (const uint64_t digits : {10, 12, 15, 20, 25, 30, 40, 50, 60, 80}) {
            if (digits * ten % 10 != 0) continue;
            const uint64_t white = 4 * (digits * ten / 10);
            if (double(white) >= *high) return uint32_t(white);
        }
    return 4000000000u;
}

uint32_t legendHeight(uint32_t width) {
    // In dots: 4 free, 7 for the bar, 2 free, 7 for the numbers, 3 free, 7 for the title, and 3 free.
    return 33 * dotSize(width);
}

Image heatMap(std::span<const float> costs, Resolution resolution, uint32_t white) {
    if (white == 0) white = whiteCost(costs);
    Image image(resolution.width, resolution.height + legendHeight(resolution.width));
    for (size_t i = 0; i < costs.size(); ++i) image.pixels[i] = heatColor(double(costs[i]) / white);
    drawLegend(image, resolution.height, white);
    return image;
}

}  // namespace bvhio
