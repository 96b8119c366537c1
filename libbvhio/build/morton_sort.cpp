// A radix sort from the most significant bits down that moves only indices. Codes stay where they are:
// triangles of a mesh that are near in space tend to be near in memory. A run of indices is distributed over
// buckets by its next bits until it is short. Then a code, without the bits that all codes of the run share,
// fits into one word together with its place in the run, and such words are sorted in the cache.

#include "build/morton_sort.h"

#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "core/parallel.h"

namespace bvhio {
namespace {

constexpr uint32_t kShort = 1u << 12;  // the longest run that is sorted in the cache
constexpr uint32_t kTask = 1u << 14;   // the fewest indices that a task sorts
constexpr size_t kGrain = 1u << 15;    // indices that a task distributes

/// Indices [begin, begin + count) whose codes share `common` leading bits. `side` is the array that has them.
struct Run {
    uint32_t begin, count, common, side;
};

/// Sorts keys that all differ: by the digits that matter, and then by insertion.
class KeySort {
  public:
    /// Sorts keys. `differing` has the bits in which not all keys agree. The result may be in either array.
    static uint64_t* sort(uint64_t* keys, uint64_t* spare, uint32_t count, uint64_t differing) {
        if (count > kMany)
            keys = distribute<3>(keys, spare, count, differing);
        else if (count > kFew)
            keys = distribute<2>(keys, spare, count, differing);
        insert(keys, count);
        return keys;
    }

  private:
    static constexpr uint32_t kFew = 32, kMany = 1024;

    /// Sorts by the highest kPasses * 8 bits that differ.
    template <uint32_t kPasses>
    static uint64_t* distribute(uint64_t* keys, uint64_t* spare, uint32_t count, uint64_t differing) {
        const auto lowest = uint32_t(std::max(0, int(std::bit_width(differing)) - int(8 * kPasses)));
        uint32_t counts[kPasses][256] = {};
        for (uint32_t i = 0; i < count; ++i)
            for (uint32_t pass = 0; pass < kPasses; ++pass)
                ++counts[pass][keys[i] >> (lowest + 8 * pass) & 255];
        for (uint32_t pass = 0; pass < kPasses; ++pass) {
            uint32_t* next = counts[pass];
            uint32_t sum = 0;
            for (uint32_t digit = 0; digit < 256; ++digit) sum += std::exchange(next[digit], sum);
            const uint32_t shift = lowest + 8 * pass;
            for (uint32_t i = 0; i < count; ++i) spare[next[keys[i] >> shift & 255]++] = keys[i];
            std::swap(keys, spare);
        }
        return keys;
    }

    /// Sorts by insertion: few keys are out of place now, and not far. If many are, because they share all
    /// those digits, uses another sort.
    static void insert(uint64_t* keys, uint32_t count) {
        uint32_t steps = 16 * count;
        for (uint32_t i = 1; i < count; ++i) {
            const uint64_t key = keys[i];
            uint32_t to = i;
            while (to > 0 && keys[to - 1] > key) {
                keys[to] = keys[to - 1];
                --to;
            }
            keys[to] = key;
            if (i - to > steps) return std::sort(keys, keys + count);
            steps -= i - to;
        }
    }
};

class CodeSort {
  public:
    CodeSort(std::span<const uint64_t> codes, uint32_t* triangles, uint8_t* levels)
        : codes_(codes), scratch_(codes.size()), levels_(levels), sides_{triangles, scratch_.data()} {}

    void sort() {
        const auto count = uint32_t(codes_.size());
        parallelChunks(count, kGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) sides_[1][i] = uint32_t(i);
        });
        sort({0, count, 0, 1});
    }

  private:
    /// Sorts a run into sides_[0].
    void sort(Run run) {
        // Places must fit into the bits that are free once the common bits are left out.
        const auto fits = [&] {
            return uint32_t(std::bit_width(run.count - 1)) <= run.common + 64 - kMortonBits;
        };
        if (run.count <= kShort && fits()) return sortShort(run);
        // The whole order rarely shares many bits, so skip the pass that counts them.
        if (run.common > 0 || run.count <= kGrain) run.common = uint32_t(std::countl_zero(differing(run)));
        if (run.common >= kMortonBits) return keepOrder(run);
        if (run.count <= kShort && fits()) return sortShort(run);
        distribute(run);
    }

    /// Returns the bits in which not all codes of a run agree.
    uint64_t differing(const Run& run) const {
        const uint32_t* indices = sides_[run.side] + run.begin;
        const uint64_t first = codes_[indices[0]];
        uint64_t bits = 0;
        for (uint32_t i = 1; i < run.count; ++i) bits |= codes_[indices[i]] ^ first;
        return bits;
    }

    /// Returns the level between a place and the next one if their codes are equal.
    uint8_t tieLevel(uint32_t place) const {
        return uint8_t(kMortonBits + uint32_t(std::countl_zero(place ^ (place + 1))));
    }

    uint8_t levelBetween(uint32_t place, uint64_t code, uint64_t next) const {
        return code == next ? tieLevel(place) : uint8_t(std::countl_zero(code ^ next));
    }

    /// Finishes a run of equal codes, which is in the order of ids already.
    void keepOrder(const Run& run) {
        if (run.side != 0) std::copy_n(sides_[run.side] + run.begin, run.count, sides_[0] + run.begin);
        for (uint32_t i = run.begin; i + 1 < run.begin + run.count; ++i) levels_[i] = tieLevel(i);
    }

    /// Sorts a short run in the cache.
    void sortShort(const Run& run) {
        const uint32_t count = run.count;
        uint32_t* const to = sides_[0] + run.begin;
        uint32_t indices[kShort];
        std::copy_n(sides_[run.side] + run.begin, count, indices);
        uint64_t keyArrays[2][kShort];
        uint64_t* keys = keyArrays[0];
        uint64_t differing = 0;
        for (uint32_t i = 0; i < count; ++i) {
            keys[i] = codes_[indices[i]] << run.common | i;
            differing |= keys[i] ^ keys[0];
        }
        keys = KeySort::sort(keys, keyArrays[1], count, differing);
        const uint64_t places = std::bit_ceil(count) - 1;
        for (uint32_t i = 0; i < count; ++i) to[i] = indices[keys[i] & places];
        uint8_t* const levels = levels_ + run.begin;
        for (uint32_t i = 0; i + 1 < count; ++i) {
            const uint64_t bits = (keys[i] ^ keys[i + 1]) & ~places;
            levels[i] =
                bits == 0 ? tieLevel(run.begin + i) : uint8_t(int(run.common) + std::countl_zero(bits));
        }
    }

    /// Moves the indices to the other array, sorted by their next bits, and sorts the runs that share these
    /// bits.
    void distribute(const Run& run) {
        const uint32_t* from = sides_[run.side] + run.begin;
        uint32_t* const to = sides_[run.side ^ 1] + run.begin;
        // If codes were spread evenly, buckets would have about 256 indices.
        const auto digit = uint32_t(std::clamp(int(std::bit_width(run.count)) - 8, 6, 12));
        const uint32_t buckets = 1u << digit;
        const auto bucketOf = [&](uint32_t index) {
            return uint32_t(codes_[index] << run.common >> (64 - digit));
        };

        // Count the indices of each bucket, chunk by chunk.
        const size_t chunks = (run.count + kGrain - 1) / kGrain;
        std::vector<uint32_t> next(chunks * buckets);  // the place of each chunk's next index of each bucket
        parallelChunks(run.count, kGrain, [&](size_t begin, size_t end) {
            uint32_t* const counts = next.data() + begin / kGrain * buckets;
            for (size_t i = begin; i < end; ++i) ++counts[bucketOf(from[i])];
        });

        // Compute the places of buckets, and of each chunk's share of a bucket.
        std::vector<uint32_t> places(buckets);  // the place of each bucket's next index of any chunk
        for (size_t i = 0; i < next.size(); ++i) places[i % buckets] += next[i];
        std::vector<Run> runs;
        const uint32_t common = std::min(run.common + digit, kMortonBits);
        uint32_t sum = 0;
        for (uint32_t bucket = 0; bucket < buckets; ++bucket) {
            const uint32_t count = std::exchange(places[bucket], sum);
            if (count > 0) runs.push_back({run.begin + sum, count, common, run.side ^ 1});
            sum += count;
        }
        for (size_t i = 0; i < next.size(); ++i)
            places[i % buckets] += std::exchange(next[i], places[i % buckets]);

        // Move the indices, and sort the buckets.
        parallelChunks(run.count, kGrain, [&](size_t begin, size_t end) {
            uint32_t* const own = next.data() + begin / kGrain * buckets;
            for (size_t i = begin; i < end; ++i) to[own[bucketOf(from[i])]++] = from[i];
        });
        sortAll(runs);
        for (size_t i = 0; i + 1 < runs.size(); ++i) {
            const uint32_t last = runs[i + 1].begin - 1;
            levels_[last] = levelBetween(last, codes_[sides_[0][last]], codes_[sides_[0][last + 1]]);
        }
    }

    /// Sorts runs by tasks of at least kTask indices each.
    void sortAll(const std::vector<Run>& runs) {
        TaskGroup group;
        size_t first = 0;
        uint32_t waiting = 0;
        for (size_t i = 0; i < runs.size(); ++i) {
            waiting += runs[i].count;
            if (i + 1 == runs.size()) {
                for (size_t k = first; k <= i; ++k) sort(runs[k]);
            } else if (waiting >= kTask) {
                group.run([this, &runs, first, i] {
                    for (size_t k = first; k <= i; ++k) sort(runs[k]);
                });
                first = i + 1;
                waiting = 0;
            }
        }
        group.wait();
    }

    std::span<const uint64_t> codes_;
    Buffer<uint32_t> scratch_;
    uint8_t* const levels_;
    uint32_t* const sides_[2];
};

}  // namespace

void sortCodes(std::span<const uint64_t> codes, uint32_t* triangles, uint8_t* levels) {
    CodeSort(codes, triangles, levels).sort();
}

}  // namespace bvhio
