// Reads a scene from a file of any supported kind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
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
    std::string name;  // the source's name of it, or "". The name of a file is not part of its content
    std::vector<Vec3> vertices;
    std::vector<TriangleIndices> triangles;  // empty for points and lines
};

/// The upper 3 x 4 of an affine matrix, row by row. In double, so that a chain of nodes is rounded once, with
/// the vertices.
using Transform = std::array<double, 12>;
inline constexpr Transform kIdentityTransform{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/// A mesh placed in the world. `name` replaces the mesh's own name where it is not empty: a file may have
/// the same mesh under several names. `joinsPrevious` says that this instance and the one before are parts of
/// one thing in one place: the primitives of a glTF mesh.
struct Instance {
    uint32_t mesh = 0;
    Transform transform = kIdentityTransform;
    std::string name = {};
    bool joinsPrevious = false;
};

/// How much of a file is not in the imported scene.
struct LeftOut {
    uint64_t points = 0, lines = 0;  // mesh primitives of glTF; elements of OBJ and PLY
    uint64_t withoutPositions = 0;   // mesh primitives
    uint64_t unusedMeshes = 0;       // glTF meshes that no node of the imported scene uses
    uint64_t skins = 0;              // nodes whose meshes stand in the bind pose: skins are not applied
    uint64_t morphTargets = 0;       // of the meshes that are used: their weights are not applied
    uint64_t cameras = 0;            // nodes with a camera

    bool hasGeometry() const { return points + lines + withoutPositions + unusedMeshes > 0; }
    bool hasPose() const { return skins + morphTargets > 0; }
    bool operator==(const LeftOut&) const = default;
};

/// A scene as its file has it: shared meshes and where they stand, in scene order (glTF: depth first through
/// the nodes of the default scene, or of the first scene where the file names none). OBJ, PLY, STL and DRC
/// files give one mesh with one instance.
struct ImportedScene {
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    LeftOut leftOut = {};
};

/// Reads glTF, GLB, OBJ, PLY, STL or Draco (.drc). The content decides which it is; the file name decides
/// where the content does not. Throws Error: io for a file that cannot be read, invalid for a damaged one,
/// unsupported for a required extension that is not known (by name), for glTF 1.0 and for another kind of
/// file. Vertices and indices are as the file has them: flatten checks them.
ImportedScene importFile(const std::filesystem::path& path);

/// The same from memory; `name` is for messages, and its extension is a hint. External buffers are looked for
/// in `directory`.
ImportedScene importBytes(std::span<const std::byte> bytes, const std::string& name,
                          const std::filesystem::path& directory);

/// The kind of scene file that bytes look like, for messages: "GLB", "glTF", "OBJ", "PLY", "STL" or "Draco",
/// or "" for anything else. The extension of `name` is a hint.
std::string_view sceneKind(std::span<const std::byte> bytes, const std::string& name);

/// Places every instance: one Geometry per instance, in order, named as Instance says. Vertices that no
/// triangle uses are left out; transforms are applied in double and rounded once. Pass the imported scene as
/// an rvalue: one mesh where it stands is moved, not copied. Throws Error: invalid for an index out of range,
/// a vertex that is used and not finite (mesh and vertex named), no triangles, and as ImportOptions asks;
/// unsupported for 2^31 triangles or more.
Scene flatten(ImportedScene imported, const ImportOptions& options);

/// The same as an instanced scene: each mesh once, in its own space, and its instances, with transforms
/// rounded to float. Instances that stand together (Instance::joinsPrevious) make one mesh; meshes with the
/// same parts are stored once, with the names of the first. An instance gets a mesh of its own, with its
/// triangles moved to their place and the identity as its transform, where its transform flattens the mesh,
/// is so skewed that rays would lose precision, or leaves the range of floats. Meshes without triangles are
/// left out, but still count in the numbers of geometries, which are those that flatten gives.
/// `onDegenerate` looks at triangles in their meshes' spaces. Throws as flatten does, and unsupported when
/// all instances together have 2^31 triangles or more.
Scene shareMeshes(ImportedScene imported, const ImportOptions& options);

}  // namespace bvhio
