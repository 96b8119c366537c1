// Which form holds a tree best: each candidate is made, measured, and compared with the aabb form of the same
// tree.
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
    uint64_t rays = 32768;  // of each set, at most
    uint64_t seed = 1;
    uint32_t rounds = 5;
    Progress* progress = nullptr;  // counts candidates
};

/// What a candidate takes and what it costs.
struct TunedEncoding {
    EncodingCandidate candidate;
    uint64_t nodeBytes = 0;  // in memory
    double bytesPerPrimitive = 0;
    double nc = 0, blb = 0;  // per ray of both sets, as in metrics/metrics.h
    double mraysPerSecond = 0;
    double slowdownPrimary = 1, slowdownDiffuse = 1;  // time over that of the aabb form
    double slowdown = 1;                              // their geometric mean
    std::string refusal = {};  // why the form can't hold the tree, when it can't: the rest says nothing
};

/// Measures the candidates that a tree with exact boxes can be stored as. The sample is of primary and
/// diffuse rays; closest hits are traced on one thread and timed by its processor time, in rounds of aabb and
/// candidate in turn, of which the medians count; one round where the candidate takes many times as long. So
/// slowdowns vary from run to run, by some percent; all else is the same every time.
std::vector<TunedEncoding> measureEncodings(const Scene& scene, const Bvh& bvh,
                                            std::span<const EncodingCandidate> candidates,
                                            const TuneOptions& options);

/// Whether some other row is no larger and no slower, and one of the two is better.
bool isDominated(const TunedEncoding& row, std::span<const TunedEncoding> rows);

/// The fastest row of at most so many node bytes per primitive, the smaller of equally fast ones; null when
/// there is none.
const TunedEncoding* fastestWithin(std::span<const TunedEncoding> rows, double maxBytesPerPrimitive);
/// The smallest row of at most that slowdown, the faster of equally small ones; null when there is none.
const TunedEncoding* smallestWithin(std::span<const TunedEncoding> rows, double maxSlowdown);

/// The rows as CSV with a heading: form, parameters, bytes_per_primitive, NC, BLB, mrays_per_second,
/// slowdown, slowdown_primary, slowdown_diffuse, status (chosen, frontier, dominated, or why it was refused).
std::string csvOf(std::span<const TunedEncoding> rows, const TunedEncoding* chosen);

}  // namespace bvhio
