// Reads whole files into memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/shared_array.h"

namespace bvhio {

/// Returns all bytes of a file. Throws Error io for a file that cannot be read, and for a directory.
AlignedVector<std::byte> readFile(const std::filesystem::path& path);

}  // namespace bvhio
