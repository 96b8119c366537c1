// glTF 2.0, as text or binary (GLB).
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "importers/import.h"

namespace bvhio {

/// Reads the default scene of a glTF file (its first scene when the file names none; all root nodes when it
/// has no scene): one mesh per mesh primitive that a node uses, in the order of first use, and one instance
/// per node, instance of EXT_mesh_gpu_instancing and mesh primitive. Nodes are where they stand without
/// animation. Skins and morph targets are not applied; points, lines and cameras are not read; all of them
/// are counted (LeftOut). Reads KHR_draco_mesh_compression, KHR_mesh_quantization, EXT_meshopt_compression
/// and EXT_mesh_gpu_instancing; extensions of materials and lights change nothing. Textures are not read.
/// External buffers must lie in `directory` or below. Throws Error: invalid for damaged files, io for a
/// buffer that cannot be read, unsupported for a required extension that is not known and for glTF 1.0,
/// resources for a file that uses its few bytes over and over to make too many instances or triangles.
ImportedScene readGltf(std::span<const std::byte> bytes, const std::string& name,
                       const std::filesystem::path& directory);

}  // namespace bvhio
