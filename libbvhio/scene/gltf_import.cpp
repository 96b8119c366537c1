#include "scene/gltf_import.h"

#include "core/error.h"
namespace bvhio {
ImportedScene readGltf(std::span<const std::byte>, const std::string& name, const std::filesystem::path&) {
    throw Error(ErrorKind::unsupported, name + ": glTF files cannot be read yet");
}
}  // namespace bvhio
