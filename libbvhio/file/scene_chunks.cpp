#include "file/scene_chunks.h"

#include <algorithm>

#include "core/bytes.h"
#include "file/instance_chunks.h"
#include "file/utf8.h"
#include "importers/draco_mesh.h"
#include "scene/check_scene.h"
#include "scene/scene_order.h"

namespace bvhio {
namespace {

constexpr size_t kSceneSize = 64;
constexpr uint32_t kRawEncoding = 0, kDracoEncoding = 1;
constexpr uint32_t kHasSourcePrimitives = 1, kHasInstances = 2;

struct SceneParameters {
    uint64_t vertices, triangles, geometries, nameBytes;
    uint32_t encoding, flags;
    InstanceCounts instances;
};

SceneParameters readParameters(ChunkSequence& chunks) {
    const Bytes payload = chunks.expect(kSceneType, kSceneSize);
    ByteReader reader(payload, "chunk SCEN");
    SceneParameters p{};
    p.vertices = reader.u64();
    p.triangles = reader.u64();
    p.geometries = reader.u64();
    p.nameBytes = reader.u64();
    p.encoding = reader.u32();
    p.flags = reader.u32();
    p.instances.meshes = reader.u32();
    p.instances.instances = reader.u32();
    const bool isInstanced = (p.flags & kHasInstances) != 0;
    if (!reader.skipZeros(reader.remaining()) || p.flags > (kHasSourcePrimitives | kHasInstances) ||
        (!isInstanced && (p.instances.meshes != 0 || p.instances.instances != 0)))
        chunks.fail(FindingId::payloadReserved, "a reserved field is not zero");
    constexpr uint64_t kMax32 = 0xFFFFFFFF;
    if (p.vertices == 0 || p.vertices > kMax32 || p.triangles == 0 || p.triangles > kMax32 >> 1 ||
        p.geometries == 0 || p.geometries > kMax32 || p.nameBytes > kMax32)
        chunks.fail(FindingId::sceneCounts,
                    std::to_string(p.vertices) + " vertices, " + std::to_string(p.triangles) +
                        " triangles, " + std::to_string(p.geometries) + " geometries, " +
                        std::to_string(p.nameBytes) + " bytes of names are out of range");
    if (isInstanced && (p.instances.meshes == 0 || p.instances.meshes > p.geometries ||
                        p.instances.instances == 0 || p.instances.instances > kMaxPrimitives))
        chunks.fail(FindingId::sceneCounts, std::to_string(p.instances.meshes) + " meshes and " +
                                                std::to_string(p.instances.instances) +
                                                " instances are out of range");
    if (isInstanced && p.encoding == kDracoEncoding)
        chunks.fail(FindingId::treeOfInstances, "a scene with instances cannot be stored with Draco");
    if (p.encoding > kDracoEncoding)
        chunks.fail(FindingId::unknownGeometryEncoding,
                    "unknown geometry encoding " + std::to_string(p.encoding) + ": use a newer bvhx");
    return p;
}

std::vector<Geometry> readGeometries(ChunkSequence& chunks, const SceneParameters& parameters) {
    const Bytes payload = chunks.expect(kGeometriesType, parameters.geometries * 8 + parameters.nameBytes);
    ByteReader reader(payload, "chunk GEOM");
    std::vector<Geometry> geometries(parameters.geometries);
    std::vector<uint32_t> nameLengths(parameters.geometries);
    uint64_t triangles = 0, nameBytes = 0;
    for (size_t i = 0; i < geometries.size(); ++i) {
        geometries[i].firstTriangle = uint32_t(triangles);
        geometries[i].triangleCount = reader.u32();
        nameLengths[i] = reader.u32();
        triangles += geometries[i].triangleCount;
        nameBytes += nameLengths[i];
    }
    if (triangles != parameters.triangles || nameBytes != parameters.nameBytes)
        chunks.fail(FindingId::geometryRuns, "the geometries have " + std::to_string(triangles) +
                                                 " triangles and " + std::to_string(nameBytes) +
                                                 " bytes of names, but SCEN states " +
                                                 std::to_string(parameters.triangles) + " and " +
                                                 std::to_string(parameters.nameBytes));
    for (size_t i = 0; i < geometries.size(); ++i) {
        geometries[i].name = reader.string(nameLengths[i]);
        if (!isUtf8(geometries[i].name))
            chunks.fail(FindingId::text, "the name of geometry " + std::to_string(i) + " is not UTF-8");
    }
    return geometries;
}

/// Reads vertices and triangles from the Draco chunk.
void readDraco(ChunkSequence& chunks, const SceneParameters& parameters, Scene& scene) {
    const Bytes payload = chunks.expect(kDracoType, ChunkSequence::kAnySize);
    DracoMesh mesh;
    try {
        mesh = decodeDraco(payload, "its payload");
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::unsupported) throw;  // by a reader without Draco
        chunks.fail(FindingId::draco, error.what());
    }
    if (mesh.vertices.size() != parameters.vertices || mesh.triangles.size() != parameters.triangles)
        chunks.fail(FindingId::draco, "the payload decodes to " + std::to_string(mesh.vertices.size()) +
                                          " vertices and " + std::to_string(mesh.triangles.size()) +
                                          " triangles, not to SCEN's counts");
    scene.vertices = std::move(mesh.vertices);
    scene.triangles = std::move(mesh.triangles);
}

/// Checks an array of the scene, which is the payload of the chunk that was read last.
void checkArray(ChunkSequence& chunks, uint32_t type, std::vector<Finding> (*check)(const Scene&, size_t),
                const Scene& scene) {
    if (chunks.isTrusted()) return;
    std::vector<Finding> findings = check(scene, chunks.maxPerId());
    for (Finding& finding : findings) finding.chunk = chunkTypeName(type);
    chunks.addFindings(std::move(findings), chunks.payloadOffset());
}

}  // namespace

StoredScene storeScene(const Scene& scene, const WriteOptions& options) {
    if (options.geometry == GeometryEncoding::raw) return {scene, {}};
    if (scene.isInstanced())
        throw Error(ErrorKind::usage,
                    "--geometry draco: one grid cannot serve the spaces of several meshes: build without "
                    "--two-level, or keep --geometry raw");
    StoredScene stored{scene, encodeDraco(scene.vertices, scene.triangles, options.dracoPositionBits)};
    if (options.dracoVertices == VertexOrder::smaller) {
        const Scene byUse = withVerticesByUse(scene);
        std::vector<std::byte> draco =
            encodeDraco(byUse.vertices, byUse.triangles, options.dracoPositionBits);
        if (draco.size() < stored.draco.size()) stored.draco = std::move(draco);
    }
    DracoMesh mesh = decodeDraco(stored.draco, "the encoded geometry");
    stored.scene.vertices = std::move(mesh.vertices);
    stored.scene.triangles = std::move(mesh.triangles);
    return stored;
}

void writeScene(ContainerWriter& writer, const StoredScene& stored) {
    const Scene& scene = stored.scene;
    ByteWriter geometries;
    std::string names;
    for (const Geometry& geometry : scene.geometries) {
        const std::string name = toUtf8(geometry.name);
        geometries.u32(geometry.triangleCount);
        geometries.u32(uint32_t(name.size()));
        names += name;
    }
    geometries.string(names);

    ByteWriter parameters;
    parameters.u64(scene.vertices.size());
    parameters.u64(scene.triangles.size());
    parameters.u64(scene.geometries.size());
    parameters.u64(names.size());
    parameters.u32(stored.draco.empty() ? kRawEncoding : kDracoEncoding);
    parameters.u32((scene.sourcePrimitives.empty() ? 0 : kHasSourcePrimitives) |
                   (scene.isInstanced() ? kHasInstances : 0));
    parameters.u32(uint32_t(scene.meshes.size()));
    parameters.u32(uint32_t(scene.instances.size()));
    parameters.zeros(kSceneSize - parameters.bytes().size());
    writeChunk(writer, kSceneType, parameters.bytes());

    if (stored.draco.empty()) {
        writeArrayChunk(writer, kVerticesType, scene.vertices);
        writeArrayChunk(writer, kTrianglesType, scene.triangles);
    } else {
        writeChunk(writer, kDracoType, stored.draco);
    }
    writeChunk(writer, kGeometriesType, geometries.bytes());
    if (!scene.sourcePrimitives.empty())
        writeArrayChunk(writer, kSourcePrimitivesType, scene.sourcePrimitives);
    if (scene.isInstanced()) writeInstances(writer, scene);
}

Scene readScene(ChunkSequence& chunks) {
    const SceneParameters parameters = readParameters(chunks);
    Scene scene;
    if (parameters.encoding == kDracoEncoding) {
        readDraco(chunks, parameters, scene);
    } else {
        scene.vertices = chunks.expectArray<Vec3>(kVerticesType, parameters.vertices);
        checkArray(chunks, kVerticesType, checkVertices, scene);
        scene.triangles = chunks.expectArray<TriangleIndices>(kTrianglesType, parameters.triangles);
        checkArray(chunks, kTrianglesType, checkTriangles, scene);
    }
    scene.geometries = readGeometries(chunks, parameters);
    if ((parameters.flags & kHasSourcePrimitives) != 0)
        scene.sourcePrimitives = chunks.expectArray<uint32_t>(kSourcePrimitivesType, parameters.triangles);
    if ((parameters.flags & kHasInstances) != 0) readInstances(chunks, parameters.instances, scene);
    return scene;
}

}  // namespace bvhio
