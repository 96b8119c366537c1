// OBJ, PLY and STL files, each as one mesh in source order.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "importers/import.h"

namespace bvhio {

// Each function takes a whole file; `name` is the file's, for messages. Triangles are in source order,
// polygons are cut into fans (v0, vi, vi+1), and vertices keep their order and are not merged. Values are as
// the file has them: flatten checks that vertices are finite and indices in range. Each function throws Error
// invalid for damaged text or data, with the line or byte.

/// Wavefront OBJ. Reads `v` and `f`; groups, objects and materials do not split the mesh. Lines and points
/// are left out, and counted.
Mesh readObj(std::span<const std::byte> bytes, const std::string& name, LeftOut& leftOut);

/// PLY, ASCII or binary of either byte order, with polygons (`vertex_indices`) and triangle strips
/// (`tristrips`). Edges are left out, and counted as lines.
Mesh readPly(std::span<const std::byte> bytes, const std::string& name, LeftOut& leftOut);

/// STL, ASCII or binary. All solids of an ASCII file make one mesh; three vertices per triangle.
Mesh readStl(std::span<const std::byte> bytes, const std::string& name);

/// True for bytes that have the exact size of a binary STL file with the triangle count in their header.
bool isBinaryStl(std::span<const std::byte> bytes);

}  // namespace bvhio
