// The locality metrics: how far traversal jumps in the buffer of node records.
//
// A fetch reads one node record. Its address is the record's byte offset in the form's node buffer (primitive
// ids and vertices are in other buffers, and not counted). Two fetches are consecutive if a ray makes them
// one after the other, whether the second node is below the first or was popped from the stack. The first
// fetch of a ray has no predecessor, so rays are independent, and the numbers do not depend on the order of
// rays or on threads. Each metric is measured for every T in kLocalitySizes:
//
// LJC(T)  per ray  Long jumps: fetches whose offset differs from the previous fetch's by at least T bytes.
// CMC(T)  per ray  Block changes: fetches whose first byte is in another T-byte block than the first byte of the
//                  previous fetch. These are the misses of a cache with a single line of T bytes.
// WSS(T)           The working set: distinct T-byte blocks in which a fetched record begins, over all rays
//                  of the run.
//
// The names and the five sizes are those of the HeavyRT renderer. It does not count the block where a ray
// starts in WSS; we do.
#pragma once

#include <array>
#include <bit>
#include <vector>

#include "metrics/no_metrics.h"

namespace bvhio {

inline constexpr std::array<uint32_t, 5> kLocalitySizes{128, 512, 4096, 16384, 131072};

/// Sums over rays, in the order of kLocalitySizes.
struct LocalityCounts {
    std::array<uint64_t, 5> longJumps{}, blockChanges{}, workingSet{};
    bool operator==(const LocalityCounts&) const = default;
};

/// The metrics policy that counts locality. Call `finishRay` after each ray.
class LocalityMetrics : public NoMetrics {
  public:
    explicit LocalityMetrics(size_t nodeBytes) : touched_(nodeBytes / kLocalitySizes[0] / 64 + 1) {}

    void recordFetched(size_t offset, size_t) {
        const size_t block = offset / kLocalitySizes[0];
        touched_[block / 64] |= uint64_t(1) << (block % 64);
        if (previous_ != kNone) {
            const size_t distance = offset > previous_ ? offset - previous_ : previous_ - offset;
            for (size_t i = 0; i < kLocalitySizes.size(); ++i) {
                sums_.longJumps[i] += distance >= kLocalitySizes[i];
                sums_.blockChanges[i] += offset / kLocalitySizes[i] != previous_ / kLocalitySizes[i];
            }
        }
        previous_ = offset;
    }

    void finishRay() { previous_ = kNone; }

    /// Adds the counts of another part of the run, over the same nodes.
    void add(const LocalityMetrics& other) {
        for (size_t i = 0; i < kLocalitySizes.size(); ++i) {
            sums_.longJumps[i] += other.sums_.longJumps[i];
            sums_.blockChanges[i] += other.sums_.blockChanges[i];
        }
        for (size_t i = 0; i < touched_.size(); ++i) touched_[i] |= other.touched_[i];
    }

    LocalityCounts counts() const {
        LocalityCounts counts = sums_;
        std::array<size_t, 5> last;
        last.fill(kNone);
        for (size_t word = 0; word < touched_.size(); ++word)
            for (uint64_t bits = touched_[word]; bits != 0; bits &= bits - 1) {
                const size_t offset = (word * 64 + size_t(std::countr_zero(bits))) * kLocalitySizes[0];
                for (size_t i = 0; i < kLocalitySizes.size(); ++i) {
                    counts.workingSet[i] += offset / kLocalitySizes[i] != last[i];
                    last[i] = offset / kLocalitySizes[i];
                }
            }
        return counts;
    }

  private:
    static constexpr size_t kNone = ~size_t(0);
    size_t previous_ = kNone;
    LocalityCounts sums_;
    std::vector<uint64_t> touched_;  // one bit for each block of the smallest size
};

}  // namespace bvhio
