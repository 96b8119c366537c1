// Pictures and their PNG files. Only the source of this header includes libpng.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bvhio {

using Rgb = std::array<uint8_t, 3>;

/// A picture of 8-bit sRGB pixels, with rows from the top.
struct Image {
    Image(uint32_t width_, uint32_t height_, Rgb fill = {})
        : width(width_), height(height_), pixels(size_t(width_) * height_, fill) {}

    Rgb& at(uint32_t x, uint32_t y) { return pixels[size_t(y) * width + x]; }
    const Rgb& at(uint32_t x, uint32_t y) const { return pixels[size_t(y) * width + x]; }

    uint32_t width, height;
    std::vector<Rgb> pixels;
};

/// Returns the PNG file of a picture of at least one pixel. Equal pixels and the same version of zlib give
/// the same bytes: the row filter and the compression level are fixed, and no time is stored. Throws
/// Error{resources} with libpng's reason when memory runs out or a side has more than a million pixels.
/// Prints nothing.
std::vector<std::byte> encodePng(const Image& image);

/// Converts a colour in linear light to an sRGB pixel. Components outside [0, 1] are clamped.
Rgb fromLinear(double red, double green, double blue);

}  // namespace bvhio
