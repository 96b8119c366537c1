// OBJ, PLY and STL files, each as one mesh in source order.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "importers/import.h"

namespace bvhio {

// Each takes a whole file; `name` is the file's, for messages. Triangles are in
// source order, polygons are cut into fans (v0, vi, vi+1), and vertices keep their order and are not merged.
// Values are as the file has them: flatten checks that vertices are finite and indices in range. Each throws
// Error invalid for damaged text or data, with line or byte.

/// Wavefront OBJ. Reads `v` and `f`; groups, objects and materials do not split the mesh, lines and points
/// are ignored.
Mesh readObj(std::span<const std::byte> bytes, const std::string& name);

/// PLY, ASCII or binary of either byte order, with polygons (`vertex_indices`) and triangle strips
/// (`tristrips`).
Mesh readPly(std::span<const std::byte> bytes, const std::string& name);

/// STL, ASCII or binary. All solids of an ASCII file make one mesh; three vertices per triangle.
Mesh readStl(std::span<const std::byte> bytes, const std::string& name);

/// True for bytes that have the exact size of the binary STL file that their triangle count tells.
bool isBinaryStl(std::span<const std::byte> bytes);

}  // namespace bvhio
