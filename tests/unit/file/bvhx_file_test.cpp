#include "file/bvhx_file.h"

#include <gtest/gtest.h>

#include <sstream>

#include "unit/file/support.h"

namespace bvhio {
namespace {

TEST(BvhxFile, comesBackAsItWasWithEveryCodec) {
    for (const std::string codec : {"none", "zstd"}) {
        const BvhxFile file = sampleFile();
        const std::string bytes = written(file, {.codec = codec});
        const BvhxFile back = readBvhx(asBytes(bytes), "test");
        expectSameContent(file, back);
        EXPECT_EQ(written(back, {.codec = codec}), bytes) << codec;
    }
}

}  // namespace
}  // namespace bvhio
