#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "file/check.h"
#include "unit/file/support.h"

namespace bvhio {
namespace {

const std::filesystem::path kSource = BVHIO_SOURCE_DIR;

std::string fileText(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    EXPECT_TRUE(in) << path;
    return {std::istreambuf_iterator<char>(in), {}};
}

struct Malformed {
    std::filesystem::path path;
    std::string kind;
    uint32_t clause;
};

std::vector<Malformed> malformedFiles() {
    std::istringstream manifest(fileText(kSource / "tests/malformed/manifest.csv"));
    std::vector<Malformed> files;
    std::string row;
    std::getline(manifest, row);
    while (std::getline(manifest, row)) {
        std::istringstream columns(row);
        std::string file, kind, clause;
        std::getline(columns, file, ',');
        std::getline(columns, kind, ',');
        std::getline(columns, clause, ',');
        files.push_back({kSource / "tests/malformed" / file, kind, uint32_t(std::stoul(clause))});
    }
    return files;
}

TEST(Malformed, filesAreRejectedByTheirClause) {
    for (const Malformed& file : malformedFiles()) {
        try {
            readBvhx(file.path);
            ADD_FAILURE() << file.path << " was read";
        } catch (const FindingError& error) {
            EXPECT_EQ(uint32_t(error.finding().id), file.clause) << error.what();
            EXPECT_EQ(error.kind(), file.kind == "unsupported" ? ErrorKind::unsupported : ErrorKind::invalid);
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
}

TEST(Malformed, checkFindsTheClauseToo) {
    for (const Malformed& file : malformedFiles()) {
        const auto findings = checkFile(file.path);
        EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [&](const Finding& f) {
            return uint32_t(f.id) == file.clause;
        })) << file.path;
    }
}

TEST(Malformed, listingChunksNeverThrows) {
    for (const Malformed& file : malformedFiles()) {
        const ChunkList list = listChunks(file.path);
        EXPECT_TRUE(list.stop.has_value() || list.chunks.back().type == "END ") << file.path;
    }
}

/// The clauses that the table of a page lists.
std::set<uint32_t> clausesOf(const std::filesystem::path& page) {
    const std::string text = fileText(page);
    const std::regex clause(R"(\n\| R(\d{4}) \|)");
    std::set<uint32_t> numbers;
    for (std::sregex_iterator match(text.begin(), text.end(), clause), end; match != end; ++match)
        numbers.insert(uint32_t(std::stoul((*match)[1])));
    return numbers;
}

TEST(Malformed, everyClauseOfThePagesHasAFile) {
    std::set<uint32_t> clauses, covered;
    for (const auto& page : std::filesystem::directory_iterator(kSource / "format-spec"))
        if (page.path().extension() == ".md") clauses.merge(clausesOf(page.path()));
    for (const Malformed& file : malformedFiles()) covered.insert(file.clause);
    EXPECT_EQ(clauses, covered);
    for (const FindingKind& kind : findingKinds())
        if (kind.error != ErrorKind::usage) clauses.erase(uint32_t(kind.id));
    EXPECT_TRUE(clauses.empty());
}

TEST(Malformed, diagnosticsPageListsWhatTheCodeKnows) {
    std::string expected;
    for (const FindingKind& kind : findingKinds()) {
        const std::string word = kind.error == ErrorKind::usage         ? "warning"
                                 : kind.error == ErrorKind::unsupported ? "unsupported"
                                                                        : "invalid";
        expected += "| " + std::to_string(uint32_t(kind.id)) + " | " + word + " | " +
                    std::string(kind.summary) + " |\n";
    }
    const std::string page = fileText(kSource / "format-spec/diagnostics.md");
    const std::string head = "|---|---|---|\n";
    EXPECT_EQ(page.substr(page.find(head) + head.size()), expected);
}

}  // namespace
}  // namespace bvhio
