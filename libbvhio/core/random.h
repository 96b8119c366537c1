// A small seeded generator with the same numbers on every machine, unlike the distributions of std.
#pragma once

#include <cstdint>

namespace bvhio {

/// PCG32 (O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms"), XSH-RR
/// output.
class Random {
  public:
    explicit Random(uint64_t seed, uint64_t stream = 0) : increment_(stream * 2 + 1) {
        next();
        state_ += seed;
        next();
    }
    uint32_t next() {
        const uint64_t old = state_;
        state_ = old * 6364136223846793005ull + increment_;
        const auto shifted = uint32_t(((old >> 18) ^ old) >> 27);
        const auto rotation = uint32_t(old >> 59);
        return (shifted >> rotation) | (shifted << ((32 - rotation) & 31));
    }
    /// Returns a number uniform in [0, 1), in steps of 2^-24, so that every value is an exact float.
    float uniform() { return float(next() >> 8) * 0x1p-24f; }
    float uniform(float from, float to) { return from + (to - from) * uniform(); }
    /// Returns a number uniform in [0, bound), bound > 0, without a remainder's bias beyond 2^-32.
    uint32_t below(uint32_t bound) { return uint32_t((uint64_t(next()) * bound) >> 32); }

  private:
    uint64_t state_ = 0;
    uint64_t increment_;
};

}  // namespace bvhio
