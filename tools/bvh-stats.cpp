// bvh-stats: reports what a container holds, checks it, and compares it with another.
#include <filesystem>

#include "common/input.h"
#include "common/query.h"
#include "common/run_tool.h"
#include "core/report.h"
#include "file/check.h"
#include "file/chunks.h"
#include "stats/diff.h"
#include "stats/slack.h"
#include "stats/stats_report.h"

using namespace bvhio;

namespace {

const ToolInfo kTool = {
    "bvh-stats",
    "Reports what a container holds: its tree, sizes and history; checks it, and compares it with another.",
    "  bvh-build scene.glb | bvh-stats\n"
    "  bvh-stats scene.bvhx --check\n"
    "  bvh-stats before.bvhx --diff after.bvhx\n",
};

/// The input. It is read more than once, so the bytes of a pipe are kept.
struct Input {
    explicit Input(const std::string& path_)
        : path(path_), isPipe(!isRegularFile(path_)), name(inputName(path_)) {
        if (isPipe) bytes = readWholeFile(path);
    }
    BvhxFile read() const {
        if (!isPipe) return readContainer(path);
        return readContainer(bytes, name);
    }
    std::vector<Finding> check() const { return isPipe ? checkBytes(bytes, name) : checkFile(path); }
    ChunkList chunks() const { return isPipe ? listChunks(bytes, name) : listChunks(path); }
    uint64_t size() const { return isPipe ? bytes.size() : std::filesystem::file_size(path); }

    /// False also where the path leads nowhere: reading it reports why.
    static bool isRegularFile(const std::string& path) {
        std::error_code error;
        return std::filesystem::is_regular_file(path, error);
    }

    std::string path;
    bool isPipe;
    std::string name;
    std::vector<std::byte> bytes;
};

std::string flagNames(uint32_t flags) {
    std::string names = flags & kCritical ? "critical" : "ancillary";
    if (flags & kSurvivesReorder) names += ", survives reorder";
    if (flags & kSurvivesTopologyChange) names += ", survives topology change";
    return names;
}

Report chunksReport(const ChunkList& list) {
    Report chunks = Report::array();
    for (const ListedChunk& chunk : list.chunks)
        chunks.push_back({{"type", chunk.type},
                          {"name", chunk.name},
                          {"offset", chunk.header.offset},
                          {"raw_size", chunk.header.rawSize},
                          {"stored_size", chunk.header.storedSize},
                          {"codec", chunk.codec},
                          {"checksum", chunk.checksumMatches ? "right" : "WRONG"},
                          {"flags", flagNames(chunk.header.flags)}});
    return chunks;
}

Report findingsReport(const std::vector<Finding>& findings) {
    Report report = Report::array();
    for (const Finding& finding : findings)
        report.push_back({{"id", uint32_t(finding.id)},
                          {"severity", finding.severity == Finding::Severity::error ? "error" : "warning"},
                          {"message", finding.message},
                          {"chunk", finding.chunk},
                          {"offset", finding.offset == kNowhere ? Report() : Report(finding.offset)}});
    return report;
}

Report provenanceReport(const BvhxFile& file) {
    Report report = Report::array();
    for (const ProvenanceEntry& entry : file.provenance) {
        const Report options = Report::parse(entry.options, nullptr, false);
        report.push_back({{"tool", entry.tool},
                          {"version", entry.version},
                          {"options", options.is_discarded() ? Report(entry.options) : options}});
    }
    return report;
}

/// The bytes of each part of the file; `other` is provenance, unknown chunks, and the headers and padding of
/// all chunks.
Report storedBytes(const ChunkList& list, uint64_t fileSize) {
    uint64_t nodes = 0, primitives = 0, geometry = 0;
    for (const ListedChunk& chunk : list.chunks) {
        const uint32_t type = chunk.header.type;
        if (type == kPrimitivesType)
            primitives += chunk.header.storedSize;
        else if (type == kVerticesType || type == kTrianglesType || type == kDracoType ||
                 type == kGeometriesType || type == kSourcePrimitivesType || type == kSceneType ||
                 type == kMeshesType || type == kInstancesType)
            geometry += chunk.header.storedSize;
        else if (findChunkKind(type) && type != kProvenanceType && type != kEndType)
            nodes += chunk.header.storedSize;  // the chunks of any form
    }
    return {{"nodes", nodes},
            {"primitives", primitives},
            {"geometry", geometry},
            {"other", fileSize - nodes - primitives - geometry}};
}

Report summary(const BvhxFile& file, const Input& input, bool withEpo) {
    StatsOptions options{.costs = file.costs};
    if (!withEpo) options.epo.reset();
    Report report = statsReport(file.scene, file.bvh, options);
    report["bytes"]["file"] = input.size();
    report["stored_bytes"] = storedBytes(input.chunks(), input.size());
    report["version"] = std::to_string(kFormatMajor) + "." + std::to_string(kFormatMinor);
    report["provenance"] = provenanceReport(file);
    return report;
}

ExitCode stats(CommandLine& line) {
    bool check = false, chunks = false, provenance = false, levels = false, noEpo = false;
    std::string other;
    line.flag("--check", check, "check the file: print numbered findings; exit code 7 for errors");
    line.flag("--chunks", chunks, "list the chunks of the file");
    line.flag("--provenance", provenance, "list the tools that made the file, and their options");
    line.flag("--levels", levels, "report for each level how much larger its boxes are than exact ones");
    line.text("--diff", "OTHER.bvhx", other, "report how OTHER.bvhx differs; exit code 7 when it does");
    line.flag("--no-epo", noEpo, "leave out epo, the slowest part of the summary");
    line.suggestForExtra("--diff");
    QueryTool query(line);
    query.stages().begin("read", readingKind(query.input()));
    const Input input(query.input());

    // --check and --chunks report as much as they can of a damaged file, so they come before reading it.
    bool broken = false;
    std::optional<Finding> stop;
    Report asked = Report::object();
    if (check) {
        const std::vector<Finding> findings = input.check();
        asked["findings"] = findingsReport(findings);
        for (const Finding& finding : findings) broken |= finding.severity == Finding::Severity::error;
    }
    if (chunks) {
        const ChunkList list = input.chunks();
        asked["chunks"] = chunksReport(list);
        if (!check) stop = list.stop;
    }
    bool different = false;
    const bool summaryAlone = asked.empty() && !provenance && !levels && other.empty();
    if (!broken && !stop && (query.isJson() || summaryAlone || provenance || levels || !other.empty())) {
        const BvhxFile file = input.read();
        if (provenance) asked["provenance"] = provenanceReport(file);
        if (levels) addTo(asked, slackStats(file.scene, decode(file.bvh), file.costs));
        if (!other.empty()) {
            const BvhxFile second = query.readOther("--diff", other);
            if (isInstanced(file.bvh) || isInstanced(second.bvh))
                throw Error(
                    ErrorKind::usage,
                    "--diff: only compares single trees, and a scene has instances: use bvh-trace --compare");
            asked["diff"] =
                diffReport({file.scene, file.bvh, file.costs}, {second.scene, second.bvh, second.costs});
            different = !asked["diff"]["differences"].empty();
        }
        query.stages().begin("measure");
        if (query.isJson() || summaryAlone) {
            Report report = summary(file, input, !noEpo);
            if (!query.isJson() && report.contains("slack"))
                report["slack"].erase("levels");  // --levels prints them
            report.update(asked);
            asked = std::move(report);
        }
    }
    // A person expects a line; a script expects silence.
    if (check && asked["findings"].empty() && !query.isJson() && query.printsToTerminal())
        query.out() << input.name << ": no findings\n";
    query.print(!query.isJson() && asked.size() == 1 && asked.contains("diff") ? asked["diff"] : asked);
    query.finish();
    if (stop) throw FindingError(input.name, *stop);
    return broken || different ? ExitCode::findings : ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
    return runTool(kTool, argc, argv, stats);
}
