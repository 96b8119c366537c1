#include "file/scene_chunks.h"

#include <algorithm>
#include <atomic>
#include <bit>

#include "core/bytes.h"
#include "core/parallel.h"
#include "file/utf8.h"

namespace bvhio {
namespace {

constexpr size_t kSceneSize = 64;
constexpr uint32_t kRawEncoding = 0;
constexpr uint32_t kHasSourcePrimitives = 1;

struct SceneParameters {
    uint64_t vertices, triangles, geometries, nameBytes;
    uint32_t encoding, flags;
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
    if (!reader.skipZeros(reader.remaining()) || p.flags > kHasSourcePrimitives)
        chunks.fail(FindingId::payloadReserved, "a reserved field is not zero");
    constexpr uint64_t kMax32 = 0xFFFFFFFF;
    if (p.vertices == 0 || p.vertices > kMax32 || p.triangles == 0 || p.triangles > kMax32 >> 1 ||
        p.geometries == 0 || p.geometries > kMax32 || p.nameBytes > kMax32)
        chunks.fail(FindingId::sceneCounts,
                    std::to_string(p.vertices) + " vertices, " + std::to_string(p.triangles) +
                        " triangles, " + std::to_string(p.geometries) + " geometries, " +
                        std::to_string(p.nameBytes) + " bytes of names are out of range");
    if (p.encoding != kRawEncoding)
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
                                                 " bytes of names, the scene " +
                                                 std::to_string(parameters.triangles) + " and " +
                                                 std::to_string(parameters.nameBytes));
    for (size_t i = 0; i < geometries.size(); ++i) {
        geometries[i].name = reader.string(nameLengths[i]);
        if (!isUtf8(geometries[i].name))
            chunks.fail(FindingId::text, "the name of geometry " + std::to_string(i) + " is not UTF-8");
    }
    return geometries;
}

Finding geometryFinding(FindingId id, uint32_t chunk, const std::string& message) {
    return {id, Finding::Severity::error, message, chunkTypeName(chunk), kNowhere, kNowhere};
}

/// Runs bad(i) over the elements of [0, count) whose stretch `anyBad(begin, end)` says holds one, until
/// `maxFound` are found.
template <class AnyBad, class Report>
void findBad(size_t count, size_t maxFound, const AnyBad& anyBad, const Report& report) {
    std::atomic<bool> found = false;
    parallelChunks(count, 65536, [&](size_t begin, size_t end) {
        if (anyBad(begin, end)) found = true;
    });
    if (!found) return;
    for (size_t i = 0, reported = 0; i < count && reported < maxFound; ++i)
        if (anyBad(i, i + 1)) {
            report(i);
            ++reported;
        }
}

}  // namespace

void writeScene(ContainerWriter& writer, const Scene& scene) {
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
    parameters.u32(kRawEncoding);
    parameters.u32(scene.sourcePrimitives.empty() ? 0 : kHasSourcePrimitives);
    parameters.zeros(kSceneSize - parameters.bytes().size());

    writeChunk(writer, kSceneType, parameters.bytes());
    writeArrayChunk(writer, kVerticesType, scene.vertices);
    writeArrayChunk(writer, kTrianglesType, scene.triangles);
    writeChunk(writer, kGeometriesType, geometries.bytes());
    if (!scene.sourcePrimitives.empty())
        writeArrayChunk(writer, kSourcePrimitivesType, scene.sourcePrimitives);
}

Scene readScene(ChunkSequence& chunks) {
    const SceneParameters parameters = readParameters(chunks);
    Scene scene;
    scene.vertices = chunks.expectArray<Vec3>(kVerticesType, parameters.vertices);
    scene.triangles = chunks.expectArray<TriangleIndices>(kTrianglesType, parameters.triangles);
    if (const auto findings = checkScene(scene, 1); !findings.empty())
        throw FindingError(chunks.name(), findings.front());
    scene.geometries = readGeometries(chunks, parameters);
    if ((parameters.flags & kHasSourcePrimitives) != 0)
        scene.sourcePrimitives = chunks.expectArray<uint32_t>(kSourcePrimitivesType, parameters.triangles);
    return scene;
}

std::vector<Finding> checkScene(const Scene& scene, size_t maxPerId) {
    std::vector<Finding> findings;
    const std::span<const float> coordinates{&scene.vertices.data()->x, scene.vertices.size() * 3};
    // Over bits, so that the compiler can use vectors: the exponent of what is not finite is all ones, and -0
    // is one pattern.
    const auto anyNotFinite = [&](size_t begin, size_t end) {
        bool bad = false;
        for (size_t i = begin; i < end; ++i)
            bad |= (std::bit_cast<uint32_t>(coordinates[i]) & 0x7F800000u) == 0x7F800000u;
        return bad;
    };
    const auto anyNegativeZero = [&](size_t begin, size_t end) {
        bool bad = false;
        for (size_t i = begin; i < end; ++i) bad |= std::bit_cast<uint32_t>(coordinates[i]) == 0x80000000u;
        return bad;
    };
    const uint64_t vertexCount = scene.vertices.size();
    const auto anyOutOfRange = [&](size_t begin, size_t end) {
        bool bad = false;
        for (size_t i = begin; i < end; ++i) {
            const TriangleIndices& t = scene.triangles[i];
            bad |= (t.v0 >= vertexCount) | (t.v1 >= vertexCount) | (t.v2 >= vertexCount);
        }
        return bad;
    };
    findBad(coordinates.size(), maxPerId, anyNotFinite, [&](size_t i) {
        findings.push_back(geometryFinding(FindingId::vertexNotFinite, kVerticesType,
                                           "vertex " + std::to_string(i / 3) + " is not finite"));
    });
    findBad(coordinates.size(), maxPerId, anyNegativeZero, [&](size_t i) {
        findings.push_back(geometryFinding(FindingId::negativeZero, kVerticesType,
                                           "a coordinate of vertex " + std::to_string(i / 3) + " is -0"));
    });
    findBad(scene.triangles.size(), maxPerId, anyOutOfRange, [&](size_t i) {
        findings.push_back(geometryFinding(FindingId::vertexIndex, kTrianglesType,
                                           "triangle " + std::to_string(i) + " has a vertex index beyond " +
                                               std::to_string(vertexCount - 1)));
    });
    return findings;
}

PrimitiveBounds boundsOfTriangles(const Scene& scene) {
    return [&scene](std::span<const uint32_t> triangles) {
        Aabb box = Aabb::empty();
        for (const uint32_t t : triangles) box.extend(bounds(scene.triangle(t)));
        return box;
    };
}

}  // namespace bvhio
