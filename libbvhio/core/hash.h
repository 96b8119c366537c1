// XXH3-64, the one checksum of the project: of container chunks, content and hits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace bvhio {

/// XXH3-64 with seed 0 of `bytes`, as a number (files store it little-endian).
uint64_t hash64(std::span<const std::byte> bytes);

/// The same of bytes that come in pieces; the pieces' borders do not change the value.
class Hasher {
  public:
    Hasher();
    ~Hasher();
    Hasher(Hasher&&) noexcept;
    Hasher& operator=(Hasher&&) noexcept;

    void update(std::span<const std::byte> bytes);
    /// The hash of everything so far; more may follow.
    uint64_t value() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace bvhio
