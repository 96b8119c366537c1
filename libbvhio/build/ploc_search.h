// Which clusters PLOC joins: the search for each one's nearest.
#pragma once

#include <bit>

#include "build/reference.h"

namespace bvhio {

inline constexpr uint32_t kSearchGrain = 1 << 10;  // most clusters that a call searches for
inline constexpr uint32_t kRadius = 16;            // a power of two

/// Partners of cluster i are i + k and i - k, k from 1 to kRadius. Two clusters call each other by the same
/// number, lower for smaller k: 2 (k - 1), and 1 more for every other pair at that distance. For that, pairs
/// at distance k = 2^n * odd number alternate with bit n of their first one.
inline constexpr uint32_t kPartners = 2 * kRadius;

/// Where the partners are: what to add to i. At most log2 of kRadius and one more low bits of i matter.
struct PartnerOffsets {
    int8_t offsets[kPartners][kPartners];

    constexpr PartnerOffsets() : offsets{} {
        for (uint32_t i = 0; i < kPartners; ++i)
            for (uint32_t number = 0; number < kPartners; ++number) {
                const uint32_t k = number / 2 + 1;
                const bool isAfter = (i >> std::countr_zero(k) & 1) == (number & 1);
                offsets[i][number] = int8_t(isAfter ? int(k) : -int(k));
            }
    }
    int operator()(uint32_t i, uint8_t number) const { return offsets[i % kPartners][number]; }
};

/// Finds, for each cluster of [begin, end), the partner with which its common box is smallest, by number.
/// Distances that differ by less than 2^-18 count as equal; then the lowest number wins. Since partners share
/// it, the two of least distance always find each other, and of a million equal boxes all do at once.
void findNearest(const Reference* clusters, uint32_t count, uint32_t begin, uint32_t end, uint8_t* nearest);

}  // namespace bvhio
