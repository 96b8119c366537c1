// Finds the best form for a tree: each candidate is encoded, measured, and compared with the aabb form of the
// same tree.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compress/candidates.h"
#include "core/progress.h"
#include "scene/scene.h"
#include "tree/bvh.h"

namespace bvhio {

struct TuneOptions {
    uint64_t rays = 32768;  // the most of each set
    uint64_t seed = 1;
    uint32_t rounds = 5;
    Progress* progress = nullptr;  // counts candidates
};

/// The size and the cost of a candidate.
struct TunedEncoding {
    EncodingCandidate candidate;
    uint64_t nodeBytes = 0;  // in memory
    double bytesPerPrimitive = 0;
    double nc = 0, blb = 0;  // per ray of both sets, as in metrics/metrics.h
    double mraysPerSecond = 0;
    double slowdownPrimary = 1, slowdownDiffuse = 1;  // time over that of the aabb form
    double slowdown = 1;                              // their geometric mean
    std::string refusal = {};  // why the form cannot store the tree; if not empty, the rest is undefined
};

/// Measures candidates for storing a tree with exact boxes. Samples are primary and diffuse rays. Closest
/// hits are traced on one thread and timed by its processor time, in rounds that alternate between aabb and
/// candidate, and the medians are used; if the candidate takes many times as long, there is only one round.
/// Slowdowns vary by a few percent from run to run. Everything else is the same every time.
std::vector<TunedEncoding> measureEncodings(const Scene& scene, const Bvh& bvh,
                                            std::span<const EncodingCandidate> candidates,
                                            const TuneOptions& options);

/// Returns whether another row is not larger and not slower, and is smaller or faster.
bool isDominated(const TunedEncoding& row, std::span<const TunedEncoding> rows);

/// Returns the fastest row with at most `maxBytesPerPrimitive` node bytes per primitive, and the smaller of
/// equally fast rows; null if there is none.
const TunedEncoding* fastestWithin(std::span<const TunedEncoding> rows, double maxBytesPerPrimitive);
/// Returns the smallest row with at most `maxSlowdown`, and the faster of equally small rows; null if there
/// is none.
const TunedEncoding* smallestWithin(std::span<const TunedEncoding> rows, double maxSlowdown);

/// Returns the rows as CSV with a heading: form, parameters, bytes_per_primitive, NC, BLB, mrays_per_second,
/// slowdown, slowdown_primary, slowdown_diffuse, status (chosen, frontier, dominated, or why the form cannot
/// store the tree).
std::string csvOf(std::span<const TunedEncoding> rows, const TunedEncoding* chosen);

}  // namespace bvhio
