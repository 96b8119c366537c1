#include "file/instance_chunks.h"

#include "core/bytes.h"

namespace bvhio {
namespace {

constexpr size_t kInstanceSize = 64;

std::vector<SceneMesh> readMeshes(ChunkSequence& chunks, uint32_t count,
                                  std::span<const Geometry> geometries) {
    const Bytes payload = chunks.expect(kMeshesType, uint64_t(count) * 4);
    ByteReader reader(payload, "chunk MESH");
    std::vector<SceneMesh> meshes(count);
    uint64_t geometry = 0;
    for (size_t i = 0; i < meshes.size(); ++i) {
        meshes[i].geometryCount = reader.u32();
        uint64_t triangles = 0;
        if (meshes[i].geometryCount <= geometries.size() - geometry)
            for (const Geometry& g : geometries.subspan(geometry, meshes[i].geometryCount))
                triangles += g.triangleCount;
        if (triangles == 0)
            chunks.fail(FindingId::meshRuns, "mesh " + std::to_string(i) +
                                                 " has no triangles, or has geometries that do not exist");
        geometry += meshes[i].geometryCount;
    }
    if (geometry != geometries.size())
        chunks.fail(FindingId::meshRuns, "the meshes have " + std::to_string(geometry) +
                                             " geometries, but the scene has " +
                                             std::to_string(geometries.size()));
    return meshes;
}

}  // namespace

void writeInstances(ContainerWriter& writer, const Scene& scene) {
    ByteWriter meshes;
    for (const SceneMesh& mesh : scene.meshes) meshes.u32(mesh.geometryCount);
    writeChunk(writer, kMeshesType, meshes.bytes());
    ByteWriter instances;
    for (const SceneInstance& instance : scene.instances) {
        for (const float number : instance.objectToWorld) instances.f32(number);
        instances.u32(instance.mesh);
        instances.u32(instance.firstGeometry);
        instances.zeros(8);
    }
    writeChunk(writer, kInstancesType, instances.bytes());
}

void readInstances(ChunkSequence& chunks, const InstanceCounts& counts, Scene& scene) {
    scene.meshes = readMeshes(chunks, counts.meshes, scene.geometries);
    const Bytes payload = chunks.expect(kInstancesType, uint64_t(counts.instances) * kInstanceSize);
    ByteReader reader(payload, "chunk INST");
    scene.instances.resize(counts.instances);
    uint64_t geometry = 0;  // the first geometry that the next instance may have
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        SceneInstance& instance = scene.instances[i];
        for (float& number : instance.objectToWorld) number = reader.f32();
        instance.mesh = reader.u32();
        instance.firstGeometry = reader.u32();
        const std::string name = "instance " + std::to_string(i);
        if (!reader.skipZeros(8)) chunks.fail(FindingId::payloadReserved, "a reserved field is not zero");
        if (!inverse(instance.objectToWorld))
            chunks.fail(FindingId::instanceTransform,
                        "the transform of " + name + " is not finite or cannot be inverted");
        if (instance.mesh >= scene.meshes.size())
            chunks.fail(FindingId::instances, name + " refers to mesh " + std::to_string(instance.mesh) +
                                                  ", but there are only " +
                                                  std::to_string(scene.meshes.size()));
        const uint64_t end = uint64_t(instance.firstGeometry) + scene.meshes[instance.mesh].geometryCount;
        if (instance.firstGeometry < geometry || end > 0xFFFFFFFF)
            chunks.fail(FindingId::instances,
                        "the geometries of " + name + ", from " + std::to_string(instance.firstGeometry) +
                            " on, overlap those of the previous instance, or exceed 2^32");
        geometry = end;
    }
    try {
        numberInstances(scene);
    } catch (const Error& error) {
        chunks.fail(FindingId::instances, error.what());
    }
}

}  // namespace bvhio
