// A chunk whose type this version does not know.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bvhio {

/// A chunk whose type this version does not know, kept byte for byte so that a pass can copy it.
struct UnknownChunk {
    uint32_t type;
    uint32_t flags;
    std::vector<std::byte> payload;  // decoded
};

}  // namespace bvhio
