#include "scene/check_scene.h"

#include <atomic>
#include <bit>
#include <limits>
#include <string>

#include "core/parallel.h"

namespace bvhio {
namespace {

[[noreturn]] void refuse(const std::string& why) {
    throw Error(ErrorKind::invalid, "the scene " + why);
}

Finding arrayFinding(FindingId id, uint64_t offset, const std::string& message) {
    return {id, Finding::Severity::error, message, "", offset, kNowhere};
}

/// Calls report(i) for the first `maxFound` bad elements i of [0, count). anyBad(begin, end) returns whether
/// [begin, end) has a bad element. It first runs in parallel over large ranges, because most arrays have
/// none.
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

void checkCounts(const Scene& scene) {
    constexpr uint64_t kMax = std::numeric_limits<uint32_t>::max();
    if (scene.triangles.empty()) refuse("has no triangles");
    if (scene.vertices.empty()) refuse("has no vertices");
    if (scene.geometries.empty()) refuse("has no geometries: give it one for all its triangles");
    if (scene.triangles.size() > kMaxPrimitives || scene.vertices.size() > kMax ||
        scene.geometries.size() > kMax)
        throw Error(ErrorKind::unsupported, "the scene has more than " + std::to_string(kMaxPrimitives) +
                                                " triangles or " + std::to_string(kMax) +
                                                " vertices or geometries");
    if (!scene.sourcePrimitives.empty() && scene.sourcePrimitives.size() != scene.triangles.size())
        refuse("has " + std::to_string(scene.sourcePrimitives.size()) + " source primitives for " +
               std::to_string(scene.triangles.size()) + " triangles");
}

void checkGeometries(const Scene& scene) {
    uint64_t triangles = 0, nameBytes = 0;
    for (size_t i = 0; i < scene.geometries.size(); ++i) {
        const Geometry& geometry = scene.geometries[i];
        if (geometry.firstTriangle != triangles)
            refuse("has geometry " + std::to_string(i) + " start at triangle " +
                   std::to_string(geometry.firstTriangle) + ", but the geometries before it end at " +
                   std::to_string(triangles));
        triangles += geometry.triangleCount;
        nameBytes += geometry.name.size();
    }
    if (triangles != scene.triangles.size())
        refuse("has " + std::to_string(scene.triangles.size()) + " triangles, but its geometries have " +
               std::to_string(triangles));
    if (nameBytes > std::numeric_limits<uint32_t>::max())
        throw Error(ErrorKind::unsupported, "the names of the scene's geometries have more than 2^32 bytes");
}

void checkMeshes(const Scene& scene) {
    uint64_t geometries = 0;
    for (const SceneMesh& mesh : scene.meshes) geometries += mesh.geometryCount;
    if (geometries != scene.geometries.size())
        refuse("has " + std::to_string(scene.geometries.size()) + " geometries, but its meshes have " +
               std::to_string(geometries));
    Scene numbered;
    numbered.geometries = scene.geometries;
    numbered.meshes = scene.meshes;
    numberInstances(numbered);
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        if (numbered.meshes[i].triangleCount == 0)
            refuse("has a mesh without triangles: mesh " + std::to_string(i));
        if (numbered.meshes[i] != scene.meshes[i])
            refuse("has mesh " + std::to_string(i) + " whose first geometry, first triangle or triangle " +
                   "count does not match its geometries");
    }
}

void checkInstances(const Scene& scene) {
    uint64_t primitive = 0, geometry = 0;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const SceneInstance& instance = scene.instances[i];
        const std::string name = "instance " + std::to_string(i);
        if (instance.mesh >= scene.meshes.size())
            refuse("has " + name + " of mesh " + std::to_string(instance.mesh) + ", but there are only " +
                   std::to_string(scene.meshes.size()) + " meshes");
        if (!inverse(instance.objectToWorld))
            refuse("has " + name + " with a transform that is not finite or cannot be inverted");
        const SceneMesh& mesh = scene.meshes[instance.mesh];
        if (instance.firstPrimitive != primitive || instance.firstGeometry < geometry)
            refuse("has " + name +
                   " whose primitive or geometry numbers do not follow those of the instances before it");
        primitive += mesh.triangleCount;
        geometry = uint64_t(instance.firstGeometry) + mesh.geometryCount;
        if (primitive > kMaxPrimitives || geometry > std::numeric_limits<uint32_t>::max())
            throw Error(ErrorKind::unsupported, "the scene's instances have more than " +
                                                    std::to_string(kMaxPrimitives) + " triangles in all");
    }
}

}  // namespace

std::vector<Finding> checkVertices(const Scene& scene, size_t maxPerId) {
    std::vector<Finding> findings;
    const std::span<const float> coordinates{&scene.vertices.data()->x, scene.vertices.size() * 3};
    // Compare bits, so that the compiler can vectorize the loops: a number that is not finite has an exponent
    // of all ones, and -0 is one bit pattern.
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
    findBad(coordinates.size(), maxPerId, anyNotFinite, [&](size_t i) {
        findings.push_back(arrayFinding(FindingId::vertexNotFinite, i * sizeof(float),
                                        "vertex " + std::to_string(i / 3) + " is not finite"));
    });
    findBad(coordinates.size(), maxPerId, anyNegativeZero, [&](size_t i) {
        findings.push_back(arrayFinding(FindingId::negativeZero, i * sizeof(float),
                                        "a coordinate of vertex " + std::to_string(i / 3) + " is -0"));
    });
    return findings;
}

std::vector<Finding> checkTriangles(const Scene& scene, size_t maxPerId) {
    std::vector<Finding> findings;
    const uint64_t vertexCount = scene.vertices.size();
    const auto anyOutOfRange = [&](size_t begin, size_t end) {
        bool bad = false;
        for (size_t i = begin; i < end; ++i) {
            const TriangleIndices& t = scene.triangles[i];
            bad |= (t.v0 >= vertexCount) | (t.v1 >= vertexCount) | (t.v2 >= vertexCount);
        }
        return bad;
    };
    findBad(scene.triangles.size(), maxPerId, anyOutOfRange, [&](size_t i) {
        findings.push_back(arrayFinding(FindingId::vertexIndex, i * sizeof(TriangleIndices),
                                        "triangle " + std::to_string(i) + " has a vertex index beyond " +
                                            std::to_string(vertexCount - 1)));
    });
    return findings;
}

void checkScene(const Scene& scene) {
    checkCounts(scene);
    checkGeometries(scene);
    if (scene.isInstanced()) {
        checkMeshes(scene);
        checkInstances(scene);
    } else if (!scene.meshes.empty()) {
        refuse("has meshes, but no instances of them");
    }
    for (const auto check : {checkVertices, checkTriangles})
        if (const std::vector<Finding> findings = check(scene, 1); !findings.empty())
            throw Error(ErrorKind::invalid, findings.front().message);
}

}  // namespace bvhio
