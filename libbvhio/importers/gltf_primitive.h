// Triangles out of one primitive of a glTF mesh.
#pragma once

#include <string>

#include "importers/gltf_accessors.h"
#include "importers/import.h"

namespace bvhio {

/// Reads a primitive of any mode, also one with KHR_draco_mesh_compression. Points and lines give a mesh
/// without vertices and triangles. A primitive that uses few of many shared vertices gets only those. `where`
/// names the primitive in messages. Throws Error invalid for damaged accessors and for indices out of range.
Mesh readGltfPrimitive(const tinygltf::Primitive& primitive, const std::string& meshName,
                       const std::string& where, GltfAccessors& accessors, GltfBuffers& buffers);

}  // namespace bvhio
