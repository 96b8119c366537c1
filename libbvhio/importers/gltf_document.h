// A glTF file's JSON, checked and as plain structures, with its buffers still unread.
#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bvhio {

/// Where the bytes of a glTF buffer are: at a URI, or in the GLB's binary chunk when there is no URI.
struct GltfBufferSource {
    std::optional<std::string> uri;
    size_t byteLength = 0;
};

/// The parts of a glTF file that make geometry: nodes, meshes, accessors, buffer views and extensions.
struct GltfDocument {
    std::string name;  // the file's, for messages
    tinygltf::Model model;
    std::vector<GltfBufferSource> buffers;
    std::span<const std::byte> binaryChunk;
};

/// Where GltfDocument keeps a primitive's index accessor, and its number of morph targets: as attributes.
inline constexpr const char* kIndicesKey = "indices";
inline constexpr const char* kTargetsKey = "targets";

/// Reads glTF text or GLB. Throws Error: invalid for damaged or wrongly typed JSON, unsupported for a
/// required extension that is not known and for versions other than 2.
GltfDocument readGltfDocument(std::span<const std::byte> bytes, const std::string& name);

}  // namespace bvhio
