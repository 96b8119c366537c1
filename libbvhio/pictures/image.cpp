#include "pictures/image.h"

#include <png.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <new>
#include <string>

#include "core/error.h"

namespace bvhio {
namespace {

void append(png_structp png, png_bytep data, png_size_t size) {
    auto& bytes = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
    const auto* from = reinterpret_cast<const std::byte*>(data);
    // libpng is C: an exception must not pass through it.
    try {
        bytes.insert(bytes.end(), from, from + size);
    } catch (const std::bad_alloc&) {
        png_error(png, "out of memory");
    }
}

/// Keeps libpng's message. Its own handlers would print to standard error.
[[noreturn]] void leave(png_structp png, png_const_charp message) {
    auto& kept = *static_cast<std::array<char, 80>*>(png_get_error_ptr(png));
    std::snprintf(kept.data(), kept.size(), "%s", message);
    png_longjmp(png, 1);
}
void ignore(png_structp, png_const_charp) {}

}  // namespace

// libpng's simplified API is shorter, but it does not let the caller choose the row filter, and so the bytes.
std::vector<std::byte> encodePng(const Image& image) {
    std::vector<std::byte> bytes;
    std::array<char, 80> message{"out of memory"};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, leave, ignore);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    if (!info || setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        throw Error(ErrorKind::resources,
                    std::string("the picture cannot be written as PNG: ") + message.data());
    }
    png_set_write_fn(png, &bytes, append, [](png_structp) {});
    png_set_IHDR(png, info, image.width, image.height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_PAETH);
    png_set_compression_level(png, 6);
    png_write_info(png, info);
    for (uint32_t y = 0; y < image.height; ++y) png_write_row(png, image.at(0, y).data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

Rgb fromLinear(double red, double green, double blue) {
    // A square root instead of the sRGB curve is close to it, and gives the same number everywhere.
    const auto encode = [](double c) { return uint8_t(c >= 1 ? 255 : c > 0 ? std::sqrt(c) * 255 + 0.5 : 0); };
    return {encode(red), encode(green), encode(blue)};
}

}  // namespace bvhio
