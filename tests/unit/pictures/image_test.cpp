#include "pictures/image.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <string>

#include "core/error.h"

namespace bvhio {
namespace {

Image decode(const std::vector<std::byte>& bytes) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&header, bytes.data(), bytes.size())) return {0, 0};
    header.format = PNG_FORMAT_RGB;
    Image image(header.width, header.height);
    png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr);
    return image;
}

Image someImage(uint32_t width, uint32_t height) {
    Image image(width, height);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            image.at(x, y) = {uint8_t(x * 3), uint8_t(y * 7), uint8_t(x * y)};
    return image;
}

// Fails if rows are shifted, channels are swapped, or a declared filter was not applied.
TEST(Png, decodesToTheSamePixels) {
    for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 9u}, {9u, 1u}, {101u, 67u}}) {
        const Image image = someImage(width, height), back = decode(encodePng(image));
        EXPECT_EQ(back.width, width);
        EXPECT_EQ(back.height, height);
        EXPECT_EQ(back.pixels, image.pixels);
    }
}

// Fails if libpng prints its own lines beside the error that is thrown.
TEST(Png, failsWithoutPrinting) {
    testing::internal::CaptureStderr();
    try {
        encodePng(Image(1'000'001, 1));  // more than libpng writes
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::resources);
        EXPECT_NE(std::string(error.what()).find("cannot be written as PNG"), std::string::npos);
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Png, holdsNoTimeAndRepeats) {
    const auto bytes = encodePng(someImage(50, 40));
    EXPECT_EQ(bytes, encodePng(someImage(50, 40)));
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    EXPECT_EQ(text.find("tIME"), std::string::npos);
}

TEST(Image, linearLightIsClamped) {
    EXPECT_EQ(fromLinear(-1, 0.25, 2), (Rgb{0, 128, 255}));
    EXPECT_EQ(fromLinear(0, 1, 0.999999), (Rgb{0, 255, 255}));
}

}  // namespace
}  // namespace bvhio
