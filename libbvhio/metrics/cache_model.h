// A model of the caches between one processor and memory: set-associative, with replacement of the least
// recently used line.
//
// Its input is the sequence of fetches of one thread that traces the rays in their order (metrics/fetches.h),
// so its numbers do not depend on the number of threads. A fetch touches every line that it overlaps once. A
// line that the cache holds is a hit. Any other line is a miss: it comes from the next level, and replaces
// the line of its set that was touched longest ago. The set of a line is its number modulo the number of
// sets. Caches begin empty. A level after the first sees only the misses of the level before, and keeps lines
// independently of that level. There is no prefetching.
//
// Real processors prefetch, and know only roughly which line was used last. So a layout that gains here need
// not gain in time.
//
// Each array has a cache of its own, so that accesses to triangles do not hide the effect of the order of
// nodes. In addition, all arrays share one cache of the same kind, as in a processor.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/report_fwd.h"
#include "metrics/fetches.h"

namespace bvhio {

/// One level: 32K:64:8 has 32768 bytes in lines of 64 bytes, with 8 lines in each set.
struct CacheLevel {
    uint64_t bytes;
    uint64_t line;  // bytes, a power of two
    uint64_t ways;

    uint64_t sets() const { return bytes / (line * ways); }
    bool operator==(const CacheLevel&) const = default;
};

/// The levels of a cache, the nearest to the processor first.
using CacheLevels = std::vector<CacheLevel>;

/// Parses "SIZE:LINE:WAYS"s, with K, M and G for powers of 1024. Levels of one cache are separated by commas,
/// and caches that see all fetches independently by "+". Throws Error{usage} that says which one is wrong.
std::vector<CacheLevels> parseCaches(std::string_view text);

/// Returns the text that parseCaches reads back.
std::string formatCacheLevel(const CacheLevel& level);

struct CacheCounts {
    uint64_t hits = 0, misses = 0;
    bool operator==(const CacheCounts&) const = default;
};

/// A cache with its levels.
class Cache {
  public:
    /// Makes a cache for addresses below `addressBytes`. It uses at most 16 bytes of memory for each line of
    /// these addresses, however large the levels are.
    Cache(std::span<const CacheLevel> levels, uint64_t addressBytes);

    /// Touches every line that overlaps [address, address + bytes); bytes > 0.
    void touch(uint64_t address, uint64_t bytes) { touch(0, address, bytes); }
    /// Returns the counts of a level.
    const CacheCounts& counts(size_t level) const { return levels_[level].counts; }

  private:
    struct Level {
        uint32_t lineShift;
        uint64_t sets, ways;          // limited to those that the addresses can use
        std::vector<uint64_t> lines;  // of each set, the last touched first
        CacheCounts counts;

        bool touchLine(uint64_t line);
    };

    void touch(size_t level, uint64_t address, uint64_t bytes);

    std::vector<Level> levels_;
};

/// Models several kinds of caches at once: for each kind, a cache for each array and one for all arrays
/// together.
class CacheModel : public FetchListener {
  public:
    CacheModel(std::vector<CacheLevels> kinds, const FetchedArraySizes& sizes);

    void rayBegins(size_t) override {}
    void fetched(FetchedArray array, uint64_t offset, uint32_t bytes) override;

    /// Returns the object `cache` of a report: hits, misses and bytes (misses times line size, which the next
    /// level provides) of nodes in the first level; and nodes[], primitives[], indices[], vertices[] and
    /// shared[] with a row for each kind and level: level, fed_by, hits, misses, bytes, hits_per_ray,
    /// misses_per_ray and bytes_per_ray.
    Report report(uint64_t rays) const;

  private:
    struct Kind {
        CacheLevels levels;
        std::vector<Cache> own;  // by array
        Cache shared;
    };

    FetchedArraySizes bases_;  // addresses of the arrays in the shared cache
    std::vector<Kind> kinds_;
};

}  // namespace bvhio
