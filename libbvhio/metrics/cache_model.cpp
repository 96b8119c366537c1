#include "metrics/cache_model.h"

#include <algorithm>
#include <bit>
#include <charconv>

#include "core/error.h"
#include "core/report.h"
#include "core/split.h"

namespace bvhio {
namespace {

constexpr uint64_t kMaxBytes = uint64_t(1) << 40, kMaxLine = uint64_t(1) << 30, kMinLine = 16,
                   kMaxWays = 1024;
constexpr size_t kMaxLevels = 8;
constexpr uint64_t kNoLine = ~uint64_t(0);

/// Parses a whole number from 1 to 2^40, optionally followed by K, M or G. Returns 0 for anything else.
uint64_t parseSize(std::string_view text) {
    uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || value > kMaxBytes) return 0;
    const std::string_view unit = text.substr(size_t(end - text.data()));
    const int shift = unit.empty() ? 0 : unit == "K" ? 10 : unit == "M" ? 20 : unit == "G" ? 30 : -1;
    return shift < 0 || value > kMaxBytes >> shift ? 0 : value << shift;
}

std::string formatSize(uint64_t size) {
    const char* unit = "";
    for (const char* larger : {"K", "M", "G"}) {
        if (size % 1024 != 0) break;
        size /= 1024;
        unit = larger;
    }
    return std::to_string(size) + unit;
}

CacheLevel parseLevel(std::string_view text) {
    const auto refuse = [&](const std::string& why) {
        throw Error(ErrorKind::usage, "cache '" + std::string(text) + "': " + why);
    };
    const auto parts = split(text, ':');
    if (parts.size() != 3) refuse("it is not SIZE:LINE:WAYS, as in 32K:64:8");
    const CacheLevel level{parseSize(parts[0]), parseSize(parts[1]), parseSize(parts[2])};
    if (level.bytes == 0) refuse("the size must be from 1 to 1024G bytes, as in 32K");
    if (level.line < kMinLine || level.line > kMaxLine || !std::has_single_bit(level.line))
        refuse("the line must be a power of two from 16 to 1G, as in 64");
    if (level.ways == 0 || level.ways > kMaxWays)
        refuse("the number of ways must be from 1 to 1024, as in 8");
    const uint64_t set = level.line * level.ways;
    if (level.bytes % set != 0)
        refuse("the size is not a multiple of LINE x WAYS, " + std::to_string(set) + " bytes");
    return level;
}

uint64_t alignedUp(uint64_t size, uint64_t alignment) {
    return (size + alignment - 1) / alignment * alignment;
}

}  // namespace

std::vector<CacheLevels> parseCaches(std::string_view text) {
    std::vector<CacheLevels> kinds;
    size_t count = 0;
    for (const std::string_view kind : split(text, '+')) {
        kinds.emplace_back();
        for (const std::string_view level : split(kind, ',')) {
            if (++count > kMaxLevels)
                throw Error(ErrorKind::usage, "cache: there are more than " + std::to_string(kMaxLevels) +
                                                  " levels in all: give fewer");
            kinds.back().push_back(parseLevel(level));
        }
    }
    return kinds;
}

std::string formatCacheLevel(const CacheLevel& level) {
    return formatSize(level.bytes) + ":" + formatSize(level.line) + ":" + std::to_string(level.ways);
}

Cache::Cache(std::span<const CacheLevel> levels, uint64_t addressBytes) {
    for (const CacheLevel& level : levels) addressBytes = alignedUp(addressBytes, level.line);
    for (const CacheLevel& level : levels) {
        // Sets beyond the number of lines would stay empty, and so would ways beyond the lines of a set.
        const uint64_t lines = std::max(addressBytes / level.line, uint64_t(1));
        const uint64_t sets = std::min(level.sets(), lines);
        const uint64_t ways = std::min(level.ways, (lines + sets - 1) / sets);
        levels_.push_back({uint32_t(std::countr_zero(level.line)),
                           sets,
                           ways,
                           std::vector<uint64_t>(sets * ways, kNoLine),
                           {}});
    }
}

bool Cache::Level::touchLine(uint64_t line) {
    const uint64_t set = std::has_single_bit(sets) ? line & (sets - 1) : line % sets;
    uint64_t* const held = lines.data() + set * ways;
    // Move the line to the front. The lines before its old place move back by one; if it is new, the last one
    // is replaced.
    uint64_t moving = held[0];
    held[0] = line;
    for (uint64_t way = 1; moving != line && way < ways; ++way) std::swap(moving, held[way]);
    const bool hit = moving == line;
    ++(hit ? counts.hits : counts.misses);
    return hit;
}

void Cache::touch(size_t level, uint64_t address, uint64_t bytes) {
    const uint32_t shift = levels_[level].lineShift;
    for (uint64_t line = address >> shift; line <= (address + bytes - 1) >> shift; ++line)
        if (!levels_[level].touchLine(line) && level + 1 < levels_.size())
            touch(level + 1, line << shift, uint64_t(1) << shift);
}

CacheModel::CacheModel(std::vector<CacheLevels> kinds, const FetchedArraySizes& sizes) {
    uint64_t alignment = 64;  // arrays share no line
    for (const CacheLevels& levels : kinds)
        for (const CacheLevel& level : levels) alignment = std::max(alignment, level.line);
    uint64_t end = 0;
    for (size_t array = 0; array < sizes.size(); ++array) {
        bases_[array] = end;
        end += alignedUp(sizes[array], alignment);
    }
    for (CacheLevels& levels : kinds) {
        std::vector<Cache> own;
        for (const uint64_t size : sizes) own.emplace_back(levels, size);
        Cache shared(levels, end);
        kinds_.push_back({std::move(levels), std::move(own), std::move(shared)});
    }
}

void CacheModel::fetched(FetchedArray array, uint64_t offset, uint32_t bytes) {
    for (Kind& kind : kinds_) {
        kind.own[size_t(array)].touch(offset, bytes);
        kind.shared.touch(bases_[size_t(array)] + offset, bytes);
    }
}

Report CacheModel::report(uint64_t rays) const {
    const auto rows = [&](const auto& cacheOf) {
        Report list = Report::array();
        for (const Kind& kind : kinds_)
            for (size_t i = 0; i < kind.levels.size(); ++i) {
                const CacheCounts& counts = cacheOf(kind).counts(i);
                const uint64_t bytes = counts.misses * kind.levels[i].line;
                const auto perRay = [&](uint64_t sum) { return rays == 0 ? 0 : double(sum) / double(rays); };
                list.push_back({{"level", formatCacheLevel(kind.levels[i])},
                                {"fed_by", i == 0 ? "rays" : formatCacheLevel(kind.levels[i - 1])},
                                {"hits", counts.hits},
                                {"misses", counts.misses},
                                {"bytes", bytes},
                                {"hits_per_ray", perRay(counts.hits)},
                                {"misses_per_ray", perRay(counts.misses)},
                                {"bytes_per_ray", perRay(bytes)}});
            }
        return list;
    };
    const Report nodes = rows([](const Kind& kind) -> const Cache& { return kind.own[0]; });
    Report report;
    for (const char* key : {"hits", "misses", "bytes"}) report[key] = nodes[0][key];
    report["nodes"] = nodes;
    for (size_t array = 1; array < kFetchedArrayNames.size(); ++array)
        report[std::string(kFetchedArrayNames[array])] =
            rows([&](const Kind& kind) -> const Cache& { return kind.own[array]; });
    report["shared"] = rows([](const Kind& kind) -> const Cache& { return kind.shared; });
    return report;
}

}  // namespace bvhio
