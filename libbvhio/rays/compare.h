// Do two traversals of the same rays agree?
#pragma once

#include <span>
#include <vector>

#include "rays/hit_file.h"

namespace bvhio {

struct CompareOptions {
    /// 0 asks for the same bits in every field. More than 0 is for geometry that was stored with losses: two
    /// hits then agree when their t differ by at most this much of the larger one, whichever triangle they
    /// name, and a hit never agrees with a miss.
    double relativeTolerance = 0;
    size_t maxListed = 10;  // differing rays to list
};

struct HitDifference {
    size_t ray;
    HitRecord first, second;
};

struct HitComparison {
    size_t rays = 0;
    size_t differing = 0;
    size_t hitsAgainstMisses = 0;  // rays, among the differing ones, that hit on one side only
    double maxRelativeT = 0;       // the largest |t1 - t2| / max(|t1|, |t2|) where both hit, differing or not
    std::vector<HitDifference> listed;  // the first differing rays, in order
};

/// Throws Error{invalid} when the numbers of rays are not the same.
HitComparison compareHits(std::span<const HitRecord> first, std::span<const HitRecord> second,
                          const CompareOptions& options = {});

}  // namespace bvhio
