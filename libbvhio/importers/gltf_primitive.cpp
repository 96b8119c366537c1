#include "importers/gltf_primitive.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "core/plural.h"
#include "importers/draco_mesh.h"

namespace bvhio {

namespace {

/// The triangles of a list of corners, as the mode connects them.
std::vector<TriangleIndices> connect(const std::vector<uint32_t>& corners, int mode) {
    std::vector<TriangleIndices> triangles;
    const size_t count = corners.size();
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        triangles.reserve(count / 3);
        for (size_t i = 0; i + 2 < count; i += 3)
            triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    } else if (count >= 3) {
        triangles.reserve(count - 2);
        for (size_t i = 0; i + 2 < count; ++i) {
            if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
                triangles.push_back({corners[i + 1], corners[i + 2], corners[0]});
            else  // every other triangle of a strip is turned, so that all face the same way
                triangles.push_back({corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
        }
    }
    return triangles;
}

void readDraco(const tinygltf::Value& extension, int positions, const std::string& where,
               GltfAccessors& accessors, GltfBuffers& buffers, Mesh& mesh) {
    const tinygltf::Value& view = extension.Get("bufferView");
    const tinygltf::Value& attributes = extension.Get("attributes");
    const tinygltf::Value& id = attributes.IsObject() ? attributes.Get("POSITION") : attributes;
    if (!view.IsInt() || !id.IsInt() || id.Get<int>() < 0)
        throw Error(ErrorKind::invalid,
                    where + ": KHR_draco_mesh_compression has no buffer view or no POSITION");
    const std::span<const std::byte> bytes = buffers.view(view.Get<int>());
    buffers.spendCompressed(bytes.size());
    DracoMesh decoded = decodeDraco(bytes, where, uint32_t(id.Get<int>()));
    const float divisor = accessors.normalisation(positions);
    if (divisor != 0)
        for (Vec3& v : decoded.vertices)
            for (int axis = 0; axis < 3; ++axis) v[axis] = std::max(v[axis] / divisor, -1.0f);
    mesh.vertices = std::move(decoded.vertices);
    mesh.triangles = std::move(decoded.triangles);
}

/// Reads the vertices, and only those that triangles use when these are few: many primitives may share one
/// large accessor.
void readVertices(int positions, const std::string& where, GltfAccessors& accessors, Mesh& mesh) {
    const size_t count = accessors.count(positions);
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const TriangleIndices& t = mesh.triangles[i];
        const uint32_t highest = std::max({t.v0, t.v1, t.v2});
        if (highest >= count)
            throw Error(ErrorKind::invalid, where + ": triangle " + std::to_string(i) + " uses vertex " +
                                                std::to_string(highest) + ", but the mesh has only " +
                                                counted(count, "vertex", "vertices"));
    }
    if (count <= 4 * mesh.triangles.size()) {
        mesh.vertices = accessors.readVectors(positions);
        return;
    }
    std::vector<uint32_t> used;
    used.reserve(3 * mesh.triangles.size());
    for (const TriangleIndices& t : mesh.triangles) used.insert(used.end(), {t.v0, t.v1, t.v2});
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    const auto position = [&](uint32_t vertex) {
        return uint32_t(std::lower_bound(used.begin(), used.end(), vertex) - used.begin());
    };
    for (TriangleIndices& t : mesh.triangles) t = {position(t.v0), position(t.v1), position(t.v2)};
    mesh.vertices = accessors.readVectors(positions, used);
}

}  // namespace

Mesh readGltfPrimitive(const tinygltf::Primitive& primitive, const std::string& meshName,
                       const std::string& where, GltfAccessors& accessors, GltfBuffers& buffers) {
    Mesh mesh;
    mesh.name = meshName;
    if (primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        throw Error(ErrorKind::invalid,
                    where + ": its mode is " + std::to_string(primitive.mode) + ", but must be 0 to 6");
    const auto position = primitive.attributes.find("POSITION");
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES || position == primitive.attributes.end()) return mesh;

    const auto draco = primitive.extensions.find("KHR_draco_mesh_compression");
    if (draco != primitive.extensions.end()) {
        readDraco(draco->second, position->second, where, accessors, buffers, mesh);
        return mesh;
    }
    std::vector<uint32_t> corners;
    const auto indices = primitive.attributes.find(kIndicesKey);
    if (indices != primitive.attributes.end()) {
        corners = accessors.readIndices(indices->second);
    } else {
        buffers.spend(accessors.count(position->second) * sizeof(uint32_t));
        corners.resize(accessors.count(position->second));
        std::iota(corners.begin(), corners.end(), 0u);
    }
    buffers.spend(corners.size() * sizeof(TriangleIndices));
    mesh.triangles = connect(corners, primitive.mode);
    readVertices(position->second, where, accessors, mesh);
    return mesh;
}

}  // namespace bvhio
