// Reads a scene from a file of any supported kind.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
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
    std::string name;  // as the source calls it; "" where it does not. The name of a file is no content
    std::vector<Vec3> vertices;
    std::vector<TriangleIndices> triangles;  // empty for points and lines
};

/// The upper 3 x 4 of an affine matrix, row by row. In double, so that a chain of nodes is rounded once, with
/// the vertices.
using Transform = std::array<double, 12>;
inline constexpr Transform kIdentityTransform{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/// A mesh placed in the world. `name` is for a mesh that its file has under several names; when empty, the
/// mesh's own counts. `joinsPrevious` tells that this and the instance before are parts of one thing, and
/// stand in one place: the primitives of a glTF mesh.
struct Instance {
    uint32_t mesh = 0;
    Transform transform = kIdentityTransform;
    std::string name = {};
    bool joinsPrevious = false;
};

/// A scene as its file has it: shared meshes and where they stand, in scene order (glTF: depth first through
/// the default scene's nodes, or, when the file names none, its first). OBJ, PLY, STL and DRC files give one
/// mesh with one instance.
struct ImportedScene {
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
};

/// Reads glTF, GLB, OBJ, PLY, STL or Draco (.drc), told apart by content first and file name second. Throws
/// Error: io for a file that cannot be read, invalid for one that is damaged, unsupported for a required
/// extension that is not known (by name) and for a kind of file that is not known. Vertices and indices are
/// as the file has them: flatten checks them.
ImportedScene importFile(const std::filesystem::path& path);

/// The same from memory; `name` is for messages, and its extension is a hint. External buffers are looked for
/// in `directory`.
ImportedScene importBytes(std::span<const std::byte> bytes, const std::string& name,
                          const std::filesystem::path& directory);

/// Places every instance: one Geometry per instance, in order, named as Instance says. Vertices that no
/// triangle uses are left out; transforms are applied in double and rounded once. Pass the imported scene as
/// an rvalue: one mesh where it stands is moved, not copied. Throws Error: invalid for an index out of range,
/// a vertex that is used and not finite (mesh and vertex named), no triangles, and as ImportOptions asks;
/// unsupported for 2^31 triangles or more.
Scene flatten(ImportedScene imported, const ImportOptions& options);

/// The same as an instanced scene: each mesh once, in its own space, and its instances, with transforms
/// rounded to float. Meshes are what stands together (Instance::joinsPrevious), found once where several have
/// the same parts; names are those of the first. Where a transform flattens its mesh, is so skewed that
/// rays would lose precision, or leaves the floats, that instance gets a mesh of its own with its triangles
/// in their place, and the identity. What has no triangles is left out, but counts in the numbers of
/// geometries, which are those that flatten gives. `onDegenerate` looks at triangles in their meshes' spaces.
/// Throws as flatten does, and unsupported when all instances together have 2^31 triangles or more.
Scene shareMeshes(ImportedScene imported, const ImportOptions& options);

}  // namespace bvhio
