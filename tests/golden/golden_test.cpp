#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "golden/golden_files.h"
#include "unit/file/support.h"

namespace bvhio {
namespace {

const std::filesystem::path kSource = BVHIO_SOURCE_DIR, kPages = kSource / "format-spec";

std::string fileText(const std::string& path) {
    std::ifstream in(kSource / path, std::ios::binary);
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

/// While a format version is not released yet, the writer must write exactly these bytes.
void expectWrittenAgain(bool areCompressed) {
    for (const GoldenFile& golden : goldenFiles())
        if ((golden.options.codec == "zstd") == areCompressed) {
            EXPECT_TRUE(written(golden.content, golden.options) == goldenBytes(golden)) << golden.name;
        }
}

TEST(Golden, filesAreWhatTheWriterWrites) {
    expectWrittenAgain(false);
}

TEST(Golden, compressedFilesAreWhatTheWriterWrites) {
    if (ZSTD_versionNumber() != 10504)
        GTEST_SKIP() << "the files were made with zstd 1.5.4, and version " << ZSTD_versionString()
                     << " compresses otherwise";
    expectWrittenAgain(true);
}

TEST(Golden, everyFormHasAFileAndAPage) {
    std::set<std::string_view> found;
    for (const auto& file : std::filesystem::directory_iterator(kSource / "tests/golden/v1"))
        found.insert(formNameOf(readBvhx(file.path()).bvh));
    for (const FormChoice& form : forms()) {
        SCOPED_TRACE(form.name);
        EXPECT_TRUE(found.contains(form.name));
        EXPECT_TRUE(std::filesystem::exists(kPages / (std::string(form.name) + ".md")));
    }
}

TEST(Golden, contentHashIsTheSameForEveryCodec) {
    const auto hash = [](const std::string& bytes) { return bytes.substr(bytes.size() - 64, 8); };
    EXPECT_EQ(hash(written(grid(), {.codec = "none"})), hash(written(grid(), {.codec = "zstd"})));
    EXPECT_NE(hash(written(grid())), hash(written(twoTriangles())));
}

/// The file of the two triangles that a page is about: in the page's form, where there is one.
std::string twoTrianglesOf(std::string page) {
    std::replace(page.begin(), page.end(), '-', '_');
    const std::string own = "tests/golden/v1/two_triangles_" + page + ".bvhx";
    return std::filesystem::exists(kSource / own) ? fileText(own)
                                                  : fileText("tests/golden/v1/two_triangles.bvhx");
}

// Lines "    0100: 00 01 02  meaning" of the pages with clauses quote the file of the two triangles that the
// page is about; or the one that a line above them names as `two_triangles_...`.
TEST(Golden, workedBytesOfThePagesAreTrue) {
    const std::regex line("    ([0-9a-f]{4}): ((?:[0-9a-f]{2} )+) .*"), other(".*`two_triangles_(\\w+)`.*"),
        clause(R"(\| R\d{4} \|.*)");
    int pages = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kPages)) {
        if (entry.path().extension() != ".md") continue;
        const std::string page = entry.path().stem().string();
        std::string file = twoTrianglesOf(page);
        std::istringstream text(fileText("format-spec/" + page + ".md"));
        int quoted = 0, clauses = 0;
        for (std::string row; std::getline(text, row);) {
            std::smatch match;
            clauses += std::regex_match(row, clause);
            if (std::regex_match(row, match, other)) file = twoTrianglesOf(match[1]);
            if (!std::regex_match(row, match, line)) continue;
            ++quoted;
            size_t offset = std::stoul(match[1], nullptr, 16);
            std::istringstream bytes(match[2]);
            for (std::string byte; bytes >> byte; ++offset) {
                ASSERT_LT(offset, file.size()) << row;
                EXPECT_EQ(std::stoul(byte, nullptr, 16), uint8_t(file[offset])) << page << ": " << row;
            }
        }
        if (clauses == 0) {
            for (const FormChoice& form : forms()) EXPECT_NE(form.name, page) << "has no clauses";
            continue;
        }
        EXPECT_GE(quoted, 8) << page;
        ++pages;
    }
    EXPECT_GE(pages, 12);
}

}  // namespace
}  // namespace bvhio
