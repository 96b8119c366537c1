#include <gtest/gtest.h>
#include <zstd.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "golden/golden_files.h"
#include "unit/file/support.h"

namespace bvhio {
namespace {

std::string fileText(const std::string& path) {
    std::ifstream in(std::string(BVHIO_SOURCE_DIR) + "/" + path, std::ios::binary);
    EXPECT_TRUE(in) << path;
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string goldenBytes(const GoldenFile& golden) {
    return fileText("tests/golden/v1/" + golden.name + ".bvhx");
}

TEST(Golden, filesStillReadToTheirContent) {
    for (const GoldenFile& golden : goldenFiles()) {
        SCOPED_TRACE(golden.name);
        const BvhxFile read = readBvhx(asBytes(goldenBytes(golden)), golden.name);
        if (golden.options.geometry == GeometryEncoding::raw) {
            expectSameContent(golden.content, read);
            continue;
        }
        // With 8 bits over a longest side of 3, each coordinate is rounded by at most half a step.
        ASSERT_EQ(read.scene.vertices.size(), golden.content.scene.vertices.size());
        for (size_t i = 0; i < read.scene.vertices.size(); ++i)
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_NEAR(read.scene.vertices[i][axis], golden.content.scene.vertices[i][axis],
                            0.51 * 3 / 255);
        expectSameArray<TriangleIndices>(read.scene.triangles, golden.content.scene.triangles, "triangles");
        EXPECT_EQ(read.scene.geometries, golden.content.scene.geometries);
        EXPECT_EQ(read.provenance, golden.content.provenance);
    }
}

// While a format version is not released yet, the writer must write exactly these bytes.
TEST(Golden, filesAreWhatTheWriterWrites) {
    for (const GoldenFile& golden : goldenFiles()) {
        if (golden.options.codec == "zstd" && ZSTD_versionNumber() != 10504)
            continue;  // other versions compress otherwise
        EXPECT_TRUE(written(golden.content, golden.options) == goldenBytes(golden)) << golden.name;
    }
}

TEST(Golden, contentHashIsTheSameForEveryCodec) {
    const auto hash = [](const std::string& bytes) { return bytes.substr(bytes.size() - 64, 8); };
    EXPECT_EQ(hash(written(grid(), {.codec = "none"})), hash(written(grid(), {.codec = "zstd"})));
    EXPECT_NE(hash(written(grid())), hash(written(twoTriangles())));
}

// Lines "    0100: 00 01 02  meaning" of the pages quote the file of the two triangles, in the form that the
// page describes, or the file that a line above them names as `two_triangles_...`.
TEST(Golden, workedBytesOfThePagesAreTrue) {
    const std::regex line("    ([0-9a-f]{4}): ((?:[0-9a-f]{2} )+) .*"), other(".*`two_triangles(_\\w+)`.*");
    const auto ofTwoTriangles = [](const std::string& form) {
        return fileText("tests/golden/v1/two_triangles" + form + ".bvhx");
    };
    for (const auto& [page, form] : {std::pair<std::string, std::string>{"container", ""},
                                     {"chunks", ""},
                                     {"aabb", ""},
                                     {"topology", "_topology"},
                                     {"quantized", "_quantized"},
                                     {"quantized-short", "_quantized_short"},
                                     {"clusters", "_clusters"},
                                     {"ssh", "_ssh"},
                                     {"mvh", "_mvh"},
                                     {"two-level", "_two_level"},
                                     {"instances", "_instances"},
                                     {"visits", "_visits"}}) {
        std::string file = ofTwoTriangles(form);
        std::istringstream text(fileText("format-spec/" + page + ".md"));
        int quoted = 0;
        for (std::string row; std::getline(text, row);) {
            std::smatch match;
            if (std::regex_match(row, match, other)) file = ofTwoTriangles(match[1]);
            if (!std::regex_match(row, match, line)) continue;
            ++quoted;
            size_t offset = std::stoul(match[1], nullptr, 16);
            std::istringstream bytes(match[2]);
            for (std::string byte; bytes >> byte; ++offset) {
                ASSERT_LT(offset, file.size()) << row;
                EXPECT_EQ(std::stoul(byte, nullptr, 16), uint8_t(file[offset])) << page << ": " << row;
            }
        }
        EXPECT_GE(quoted, 8) << page;
    }
}

}  // namespace
}  // namespace bvhio
