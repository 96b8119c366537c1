// Whole files into memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/shared_array.h"

namespace bvhio {

/// Reads a file whole. Throws Error io when that fails, and for a directory.
AlignedVector<std::byte> readFile(const std::filesystem::path& path);

}  // namespace bvhio
