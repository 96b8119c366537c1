// The search of PLOC for the nearest cluster of each cluster.
#pragma once

#include <bit>

#include "build/reference.h"

namespace bvhio {

inline constexpr uint32_t kSearchGrain = 1 << 10;  // the most clusters of one call
inline constexpr uint32_t kRadius = 16;            // a power of two

/// The partners of cluster i are i + k and i - k, for k from 1 to kRadius. Partners have numbers, and two
/// clusters have the same number for each other. The number is 2 (k - 1), plus 1 for every other pair at
/// distance k, so it is lower for smaller k. Pairs at distance k = 2^n * odd number alternate with bit n of
/// their first cluster.
inline constexpr uint32_t kPartners = 2 * kRadius;

/// The offset from cluster i to each of its partners. It depends only on the low log2(kRadius) + 1 bits of i.
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

/// Finds for each cluster of [begin, end) the number of the partner with which its common box is smallest.
/// Areas that differ by less than 2^-18 count as equal; then the lowest number wins. Since partners share a
/// number, the two clusters with the smallest common box always find each other, and of a million equal boxes
/// all do at once.
void findNearest(const Reference* clusters, uint32_t count, uint32_t begin, uint32_t end, uint8_t* nearest);

}  // namespace bvhio
