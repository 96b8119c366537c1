// Compares the hits of two traversals of the same rays.
#pragma once

#include <span>
#include <vector>

#include "rays/hit_file.h"

namespace bvhio {

struct CompareOptions {
    /// 0 requires the same bits in every field. A tolerance above 0 is for geometry that was stored with
    /// losses: two hits then agree if their t differ by at most this fraction of the larger t, even if their
    /// triangles differ. A hit never agrees with a miss.
    double relativeTolerance = 0;
    size_t maxListed = 10;  // the most differing rays to list
};

struct HitDifference {
    size_t ray;
    HitRecord first, second;
};

struct HitComparison {
    size_t rays = 0;
    size_t differing = 0;
    size_t hitsAgainstMisses = 0;  // differing rays that hit on one side only
    double maxRelativeT = 0;  // the largest |t1 - t2| / max(|t1|, |t2|) of all rays that hit on both sides
    std::vector<HitDifference> listed;  // the first differing rays, in order
};

/// Compares hits ray by ray. Throws Error{invalid} if the numbers of rays differ.
HitComparison compareHits(std::span<const HitRecord> first, std::span<const HitRecord> second,
                          const CompareOptions& options = {});

}  // namespace bvhio
