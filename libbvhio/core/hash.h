// XXH3-64, the one checksum of the project, for container chunks, content and hits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace bvhio {

/// Returns XXH3-64 with seed 0 of `bytes` as a number (files store it little-endian).
uint64_t hash64(std::span<const std::byte> bytes);

/// Computes the same hash of bytes that arrive in pieces. Where the pieces end does not matter.
class Hasher {
  public:
    Hasher();
    ~Hasher();
    Hasher(Hasher&&) noexcept;
    Hasher& operator=(Hasher&&) noexcept;

    void update(std::span<const std::byte> bytes);
    /// Returns the hash of everything so far; more may follow.
    uint64_t value() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace bvhio
