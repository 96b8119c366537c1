// Pictures, and their PNG bytes: the only header whose source knows libpng.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bvhio {

using Rgb = std::array<uint8_t, 3>;

/// A picture of 8-bit sRGB pixels, rows from the top.
struct Image {
    Image(uint32_t width_, uint32_t height_, Rgb fill = {})
        : width(width_), height(height_), pixels(size_t(width_) * height_, fill) {}

    Rgb& at(uint32_t x, uint32_t y) { return pixels[size_t(y) * width + x]; }
    const Rgb& at(uint32_t x, uint32_t y) const { return pixels[size_t(y) * width + x]; }

    uint32_t width, height;
    std::vector<Rgb> pixels;
};

/// The PNG file of a picture of at least one pixel. The same bytes for the same pixels and version of zlib:
/// the row filter and the compression are fixed, and no time is stored.
std::vector<std::byte> encodePng(const Image& image);

/// The sRGB pixel of a colour in linear light; components outside [0, 1] are clamped.
Rgb fromLinear(double red, double green, double blue);

}  // namespace bvhio
