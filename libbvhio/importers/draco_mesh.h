// Triangle meshes as Draco data: for KHR_draco_mesh_compression, .drc files and the container's geometry
// chunk.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace bvhio {

/// The content of Draco data. Every index is in range, every coordinate finite and never -0; there may be no
/// triangles.
struct DracoMesh {
    std::vector<Vec3> vertices;
    std::vector<TriangleIndices> triangles;
};

/// Draco's largest number of bits for a quantised coordinate.
inline constexpr int kMaxDracoPositionBits = 30;

/// Encodes a mesh so that decodeDraco returns the same number of vertices and the same triangles, both in the
/// same order, including degenerate triangles and vertices that nothing uses. Positions are rounded to a grid
/// of 2^positionBits steps along the longest side of their bounds (1 to kMaxDracoPositionBits). The same mesh
/// and bits give the same bytes. Requires at least one triangle, finite vertices and indices in range. Throws
/// Error: usage for bits out of range, unsupported for more than three vertices per triangle, which Draco
/// does not decode, and for bounds whose extent is not a finite float.
std::vector<std::byte> encodeDraco(std::span<const Vec3> vertices, std::span<const TriangleIndices> triangles,
                                   int positionBits);

/// Decodes a mesh. Its positions are the attribute with the given unique id (as glTF names it), or else the
/// first POSITION attribute; integers are returned as they are, not normalised. `where` begins messages.
/// Throws Error invalid for data that is damaged, holds no mesh, or claims more vertices or triangles than
/// its size can hold; such a claim is checked before memory is allocated for it.
DracoMesh decodeDraco(std::span<const std::byte> bytes, const std::string& where,
                      std::optional<uint32_t> positionAttribute = std::nullopt);

}  // namespace bvhio
