// A model of the caches between one processor and memory: set-associative, least recently used goes first.
//
// What it is fed is the sequence of fetches that one thread makes, tracing the rays in their order
// (metrics/fetches.h): so its numbers do not depend on the number of threads. A fetch touches every line that
// it overlaps, each once. A line that the cache holds is a hit; another is a miss, which takes it from the
// next level, in the place of the line of its set that was touched longest ago. The set of a line is its
// number modulo the number of sets. Caches begin empty. A level behind another sees that one's misses alone,
// and keeps what it sees however long the level before keeps it; nothing is fetched ahead.
//
// Real processors fetch ahead and know only about which line was used last: what a layout gains here it need
// not gain by the clock.
//
// Each of the arrays that are fetched from has a cache of its own, so that what the nodes' order does is not
// hidden by what triangles do; beside these, all arrays share one cache of the same kind, as they do in a
// processor.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/report.h"
#include "metrics/fetches.h"

namespace bvhio {

/// One level: 32K:64:8 is 32768 bytes in lines of 64, 8 of them in each set.
struct CacheLevel {
    uint64_t bytes;
    uint64_t line;  // bytes, a power of two
    uint64_t ways;

    uint64_t sets() const { return bytes / (line * ways); }
    bool operator==(const CacheLevel&) const = default;
};

/// Levels, the nearest first.
using CacheLevels = std::vector<CacheLevel>;

/// Reads "SIZE:LINE:WAYS"s, with K, M and G for powers of 1024: levels of one cache are parted by commas,
/// caches of which each sees all fetches by "+". Throws Error{usage} that says which is wrong.
std::vector<CacheLevels> parseCaches(std::string_view text);

/// The text that parseCaches reads back.
std::string formatCacheLevel(const CacheLevel& level);

struct CacheCounts {
    uint64_t hits = 0, misses = 0;
    bool operator==(const CacheCounts&) const = default;
};

/// The levels of one cache.
class Cache {
  public:
    /// Every address is below `addressBytes`. Takes at most 16 bytes of memory for each line of these,
    /// however large the levels are.
    Cache(std::span<const CacheLevel> levels, uint64_t addressBytes);

    /// Touches every line that overlaps [address, address + bytes); bytes > 0.
    void touch(uint64_t address, uint64_t bytes) { touch(0, address, bytes); }
    /// By level.
    const CacheCounts& counts(size_t level) const { return levels_[level].counts; }

  private:
    struct Level {
        uint32_t lineShift;
        uint64_t sets, ways;          // as far as addresses can make a difference
        std::vector<uint64_t> lines;  // of each set, last touched first
        CacheCounts counts;

        bool touchLine(uint64_t line);
    };

    void touch(size_t level, uint64_t address, uint64_t bytes);

    std::vector<Level> levels_;
};

/// Caches of one kind for each array and one for all together; several kinds at once.
class CacheModel : public FetchListener {
  public:
    CacheModel(std::vector<CacheLevels> kinds, const FetchedArraySizes& sizes);

    void rayBegins(size_t) override {}
    void fetched(FetchedArray array, uint64_t offset, uint32_t bytes) override;

    /// The object `cache`: hits, misses and bytes (misses times line: what the next level gives) of nodes in
    /// the first level; nodes[], primitives[], indices[], vertices[] and shared[] with a row for each kind
    /// and level: level, fed_by, hits, misses, bytes, and hits_per_ray, misses_per_ray, bytes_per_ray.
    Report report(uint64_t rays) const;

  private:
    struct Kind {
        CacheLevels levels;
        std::vector<Cache> own;  // by array
        Cache shared;
    };

    FetchedArraySizes bases_;  // of the arrays where all share a cache
    std::vector<Kind> kinds_;
};

}  // namespace bvhio
