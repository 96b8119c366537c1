#include "common/form_search.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "core/error.h"
#include "core/report.h"
#include "rays/ray_sets.h"

namespace bvhio {
namespace {

const std::vector<std::string> kLimits = {"--max-bytes-per-primitive", "--max-slowdown"};
const std::vector<std::string> kSample = {"--count", "--repeat", "--seed"};

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

}  // namespace

FormSearch::FormSearch(CommandLine& line) {
    const TuneOptions defaults;
    count_ = defaults.rays;
    repeat_ = defaults.rounds;
    seed_ = defaults.seed;
    line.number(kLimits[0], maxBytes_, 0, 1e6f, "fastest form whose nodes take at most X bytes per triangle");
    line.number(kLimits[1], maxSlowdown_, 0, 1e6f, "smallest form that is at most X times slower than aabb");
    line.number(kSample[0], count_, 1, kMaxRays, "most rays per set in the search");
    line.number(kSample[1], repeat_, 1, 1000, "timed runs in the search; their median counts");
    line.number(kSample[2], seed_, 0, UINT64_MAX, "seed of the search's random rays");
    line.path("--pareto", "FILE.csv", tablePath_,
              "table of the bytes and the time of every form, which the search measures for it");
}

void FormSearch::prepare(const CommandLine& line, const std::vector<std::string>& others) {
    if (maxBytes_ >= 0 && maxSlowdown_ >= 0)
        throw Error(ErrorKind::usage, kLimits[0] + " and " + kLimits[1] + " exclude each other: give one");
    for (const std::string& name : line.given()) {
        if (contains(kSample, name) && !isWanted())
            throw Error(ErrorKind::usage, name + ": is for the search: also give " + kLimits[0] + ", " +
                                              kLimits[1] + " or --pareto");
        if (choosesForm() && !contains(kLimits, name) && !contains(kSample, name) && name != "--form" &&
            !contains(others, name))
            throw Error(ErrorKind::usage,
                        name + ": " + kLimits[maxBytes_ >= 0 ? 0 : 1] + " chooses it: leave one of them out");
    }
    if (!tablePath_.empty()) table_.emplace(tablePath_, OutputKind::text);
}

const TunedEncoding* FormSearch::search(const Scene& scene, const Bvh& bvh, const std::string& form,
                                        Progress& progress) {
    std::vector<EncodingCandidate> candidates;
    for (const EncodingCandidate& candidate : encodingCandidates())
        if (form.empty() || candidate.form == form) candidates.push_back(candidate);
    rows_ = measureEncodings(scene, bvh, candidates, {count_, seed_, repeat_, &progress});
    if (choosesForm())
        chosen_ = maxBytes_ >= 0 ? fastestWithin(rows_, maxBytes_) : smallestWithin(rows_, maxSlowdown_);
    if (table_) {
        table_->stream() << csvOf(rows_, chosen_);
        table_->commit();
    }
    return chosen_;
}

std::string FormSearch::refusal() const {
    const bool byBytes = maxBytes_ >= 0;
    const auto value = [&](const TunedEncoding& row) {
        return byBytes ? row.bytesPerPrimitive : row.slowdown;
    };
    const TunedEncoding* nearest = nullptr;
    for (const TunedEncoding& row : rows_)
        if (row.refusal.empty() && (nearest == nullptr || value(row) < value(*nearest))) nearest = &row;
    if (nearest == nullptr) return kLimits[byBytes ? 0 : 1] + ": " + rows_.front().refusal;
    return kLimits[byBytes ? 0 : 1] + ": no form stays within " + number(byBytes ? maxBytes_ : maxSlowdown_) +
           ": the nearest is " + nearest->candidate.name() + " with " + number(value(*nearest));
}

void FormSearch::assignTo(CommandLine& line) const {
    line.assign("--form", std::string(chosen_->candidate.form));
    std::istringstream words{std::string(chosen_->candidate.parameters)};
    for (std::string name, value; words >> name >> value;) line.assign(name, value);
}

Report FormSearch::recordedOptions(const CommandLine& line) const {
    Report options = line.options();
    if (chosen_ != nullptr) return options;
    for (const auto* names : {&kLimits, &kSample})
        for (const std::string& name : *names) options.erase(name.substr(2));
    return options;
}

Report FormSearch::report() const {
    Report list = Report::array();
    for (const TunedEncoding& row : rows_) {
        list.push_back({{"form", row.candidate.form}, {"parameters", row.candidate.parameters}});
        if (!row.refusal.empty()) {
            list.back()["refusal"] = row.refusal;
            continue;
        }
        list.back().update({{"bytes_per_primitive", row.bytesPerPrimitive},
                            {"NC", row.nc},
                            {"BLB", row.blb},
                            {"mrays_per_second", row.mraysPerSecond},
                            {"slowdown", row.slowdown},
                            {"slowdown_primary", row.slowdownPrimary},
                            {"slowdown_diffuse", row.slowdownDiffuse},
                            {"dominated", isDominated(row, rows_)}});
    }
    return {{"chosen", chosen_ != nullptr ? Report(chosen_->candidate.name()) : Report()},
            {"candidates", list}};
}

}  // namespace bvhio
