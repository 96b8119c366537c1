// Reads a scene from a file of any supported kind.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace bvhio {

/// What to do with triangles of zero area (two equal vertices, or three on a line).
enum class OnDegenerate { keep, drop, error };

struct ImportOptions {
    OnDegenerate onDegenerate = OnDegenerate::keep;
};

/// One mesh primitive in its own space: the unit that instances share.
struct Mesh {
    std::string name;
    std::vector<Vec3> vertices;
    std::vector<TriangleIndices> triangles;  // empty for points and lines
};

/// A mesh placed in the world. `transform` is the upper 3 x 4 of an affine matrix, row by row.
struct Instance {
    uint32_t mesh = 0;
    std::array<float, 12> transform{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
};

/// A scene as its file has it: shared meshes and where they stand, in scene order (glTF: depth first through the default scene's
/// nodes, or, when the file names none, its first). OBJ, PLY, STL and DRC files give one mesh with one instance.
struct ImportedScene {
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
};

/// Reads glTF, GLB, OBJ, PLY, STL or Draco (.drc), told apart by content first and file name second. Throws Error: io for a file
/// that cannot be read, invalid for one that is damaged or holds no triangle or a vertex that is not finite (mesh and vertex
/// named), unsupported for a required extension that is not known (by name).
ImportedScene importFile(const std::filesystem::path& path);

/// The same from memory; `name` is for messages, and its extension is a hint. `directory` is where external buffers are looked for.
ImportedScene importBytes(std::span<const std::byte> bytes, const std::string& name, const std::filesystem::path& directory);

/// Places every instance: one Geometry per instance, in order. Throws as documented for ImportOptions.
Scene flatten(const ImportedScene& imported, const ImportOptions& options);

}  // namespace bvhio
