// Random directions without libm, so that rays have the same bits everywhere.
#pragma once

#include "core/random.h"
#include "rays/vec3d.h"

namespace bvhio {

/// Returns the random stream of one ray. The counter is mixed first (by the finaliser of SplitMix64; Steele,
/// Lea and Flood 2014), because neighbouring seeds of a linear generator give neighbouring numbers.
inline Random randomStream(uint64_t seed, uint64_t index) {
    uint64_t z = seed * 0xD1342543DE82EF95ull + (index + 1) * 0x9E3779B97F4A7C15ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return Random(z ^ (z >> 31));
}

/// Returns a unit vector with cosine-weighted density about the unit vector n: the normalised sum of n and a
/// uniform point of the unit sphere, which comes from the ball by rejection.
inline Vec3d cosineDirection(Vec3d n, Random& random) {
    for (;;) {
        const double x = 2.0 * random.uniform() - 1, y = 2.0 * random.uniform() - 1,
                     z = 2.0 * random.uniform() - 1;
        const Vec3d inBall{x, y, z};
        const double squared = dot(inBall, inBall);
        if (squared > 1 || squared < 1e-12) continue;
        const Vec3d sum = n + normalize(inBall);
        if (dot(sum, sum) > 1e-12)
            return normalize(sum);  // if not, the point was opposite n, and the sum is rounding noise
    }
}

}  // namespace bvhio
