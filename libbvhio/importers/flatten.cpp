#include <atomic>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"
#include "core/plural.h"
#include "importers/import.h"

namespace bvhio {

namespace {

constexpr uint64_t kMaxTriangles = (uint64_t(1) << 31) - 1;
constexpr uint64_t kMaxVertices = std::numeric_limits<uint32_t>::max();
constexpr size_t kGrain = 1 << 15;
constexpr uint64_t kNone = std::numeric_limits<uint64_t>::max();

/// Keeps the smallest number that any thread offers, so that messages name the same vertex for any number of
/// threads.
class First {
  public:
    void offer(uint64_t number) {
        uint64_t seen = first_.load(std::memory_order_relaxed);
        while (number < seen && !first_.compare_exchange_weak(seen, number, std::memory_order_relaxed)) {
        }
    }
    uint64_t get() const { return first_.load(std::memory_order_relaxed); }

  private:
    std::atomic<uint64_t> first_{kNone};
};

std::string describe(const Mesh& mesh, uint32_t number) {
    return "mesh " + std::to_string(number) + (mesh.name.empty() ? "" : " '" + mesh.name + "'");
}

/// Checks the mesh's indices and the vertices that they use, and removes the vertices that nothing uses:
/// scanned files keep failed measurements as NaN there.
void checkAndCompact(Mesh& mesh, uint32_t number) {
    First badTriangle;
    const size_t vertexCount = mesh.vertices.size();
    parallelChunks(mesh.triangles.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const TriangleIndices& t = mesh.triangles[i];
            if (t.v0 >= vertexCount || t.v1 >= vertexCount || t.v2 >= vertexCount)
                return badTriangle.offer(i);
        }
    });
    if (badTriangle.get() != kNone) {
        const TriangleIndices& t = mesh.triangles[badTriangle.get()];
        const uint32_t index = t.v0 >= vertexCount ? t.v0 : t.v1 >= vertexCount ? t.v1 : t.v2;
        throw Error(ErrorKind::invalid, describe(mesh, number) + ": triangle " +
                                            std::to_string(badTriangle.get()) + " uses vertex " +
                                            std::to_string(index) + ", but the mesh has only " +
                                            counted(vertexCount, "vertex", "vertices"));
    }

    std::vector<uint8_t> used(vertexCount, 0);
    for (const TriangleIndices& t : mesh.triangles) used[t.v0] = used[t.v1] = used[t.v2] = 1;
    size_t usedCount = 0;
    for (size_t i = 0; i < vertexCount; ++i) {
        if (!used[i]) continue;
        ++usedCount;
        if (!isFinite(mesh.vertices[i]))
            throw Error(ErrorKind::invalid, describe(mesh, number) + ": vertex " + std::to_string(i) +
                                                " is not finite (NaN or infinity)");
    }
    if (usedCount == vertexCount) return;
    std::vector<uint32_t> newIndex(vertexCount);
    uint32_t next = 0;
    for (size_t i = 0; i < vertexCount; ++i) {
        newIndex[i] = next;
        if (used[i]) mesh.vertices[next++] = mesh.vertices[i];
    }
    mesh.vertices.resize(usedCount);
    mesh.vertices.shrink_to_fit();
    for (TriangleIndices& t : mesh.triangles) t = {newIndex[t.v0], newIndex[t.v1], newIndex[t.v2]};
}

Vec3 place(const Transform& m, const Vec3& v) {
    const double x = v.x, y = v.y, z = v.z;
    // Adding +0 turns -0 into +0.
    return {float(m[0] * x + m[1] * y + m[2] * z + m[3]) + 0.0f,
            float(m[4] * x + m[5] * y + m[6] * z + m[7]) + 0.0f,
            float(m[8] * x + m[9] * y + m[10] * z + m[11]) + 0.0f};
}

/// Where an instance's vertices and triangles go.
struct Placement {
    uint64_t firstVertex = 0, firstTriangle = 0;
};

/// A scene without triangles is refused, with what it has instead.
void refuseWithoutTriangles(const ImportedScene& imported) {
    bool hasVertices = false;
    for (const Instance& instance : imported.instances) {
        const Mesh& mesh = imported.meshes[instance.mesh];
        if (!mesh.triangles.empty()) return;
        hasVertices |= !mesh.vertices.empty();
    }
    const char* instead = imported.leftOut.points + imported.leftOut.lines > 0 ? ", only points or lines"
                          : hasVertices                                        ? ", only vertices"
                                                                               : "";
    throw Error(ErrorKind::invalid, std::string("the scene has no triangles") + instead);
}

std::vector<Placement> planPlacements(const ImportedScene& imported, uint64_t& vertexCount,
                                      uint64_t& triangleCount) {
    std::vector<Placement> placements;
    placements.reserve(imported.instances.size());
    for (const Instance& instance : imported.instances) {
        const Mesh& mesh = imported.meshes[instance.mesh];
        placements.push_back({vertexCount, triangleCount});
        vertexCount += mesh.vertices.size();
        triangleCount += mesh.triangles.size();
        if (triangleCount > kMaxTriangles || vertexCount > kMaxVertices)
            throw Error(ErrorKind::unsupported, "the scene has more than " + std::to_string(kMaxTriangles) +
                                                    " triangles or " + std::to_string(kMaxVertices) +
                                                    " vertices");
    }
    return placements;
}

[[noreturn]] void failOverflow(const ImportedScene& imported, size_t instance, uint64_t vertex) {
    const uint32_t mesh = imported.instances[instance].mesh;
    throw Error(ErrorKind::invalid, describe(imported.meshes[mesh], mesh) + ": vertex " +
                                        std::to_string(vertex) + " is not finite where instance " +
                                        std::to_string(instance) + " places it");
}

/// Copies every instance's mesh to its place.
void placeAll(const ImportedScene& imported, const std::vector<Placement>& placements,
              AlignedVector<Vec3>& vertices, AlignedVector<TriangleIndices>& triangles) {
    First badVertex;  // numbered through the scene
    parallelChunks(imported.instances.size(), 4, [&](size_t firstInstance, size_t endInstance) {
        for (size_t i = firstInstance; i < endInstance; ++i) {
            const Instance& instance = imported.instances[i];
            const Mesh& mesh = imported.meshes[instance.mesh];
            const Placement& to = placements[i];
            parallelChunks(mesh.vertices.size(), kGrain, [&](size_t begin, size_t end) {
                for (size_t v = begin; v < end; ++v) {
                    const Vec3 placed = place(instance.transform, mesh.vertices[v]);
                    if (!isFinite(placed)) badVertex.offer(to.firstVertex + v);
                    vertices[to.firstVertex + v] = placed;
                }
            });
            parallelChunks(mesh.triangles.size(), kGrain, [&](size_t begin, size_t end) {
                const auto offset = uint32_t(to.firstVertex);
                for (size_t t = begin; t < end; ++t) {
                    const TriangleIndices& source = mesh.triangles[t];
                    triangles[to.firstTriangle + t] = {source.v0 + offset, source.v1 + offset,
                                                       source.v2 + offset};
                }
            });
        }
    });
    if (badVertex.get() == kNone) return;
    size_t instance = placements.size() - 1;
    while (placements[instance].firstVertex > badVertex.get()) --instance;
    failOverflow(imported, instance, badVertex.get() - placements[instance].firstVertex);
}

/// The triangles of zero area, in order.
std::vector<uint32_t> findDegenerate(const Scene& scene) {
    const size_t count = scene.triangles.size();
    std::vector<std::vector<uint32_t>> found((count + kGrain - 1) / kGrain);
    parallelChunks(count, kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            if (area(scene.triangle(i)) == 0) found[begin / kGrain].push_back(uint32_t(i));
    });
    std::vector<uint32_t> all;
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// Removes the given triangles, and records which numbers the others had in their geometries.
void dropTriangles(Scene& scene, const std::vector<uint32_t>& dropped) {
    const size_t kept = scene.triangles.size() - dropped.size();
    if (kept == 0) throw Error(ErrorKind::invalid, "every triangle of the scene has zero area");
    AlignedVector<TriangleIndices> triangles;
    AlignedVector<uint32_t> sourcePrimitives;
    triangles.reserve(kept);
    sourcePrimitives.reserve(kept);
    size_t nextDropped = 0;
    for (Geometry& geometry : scene.geometries) {
        const auto first = uint32_t(triangles.size());
        for (uint32_t i = 0; i < geometry.triangleCount; ++i) {
            const uint32_t triangle = geometry.firstTriangle + i;
            if (nextDropped < dropped.size() && dropped[nextDropped] == triangle) {
                ++nextDropped;
                continue;
            }
            triangles.push_back(scene.triangles[triangle]);
            sourcePrimitives.push_back(i);
        }
        geometry.firstTriangle = first;
        geometry.triangleCount = uint32_t(triangles.size()) - first;
    }
    scene.triangles = std::move(triangles);
    scene.sourcePrimitives = std::move(sourcePrimitives);
}

void treatDegenerate(Scene& scene, OnDegenerate choice) {
    if (choice == OnDegenerate::keep) return;
    const std::vector<uint32_t> degenerate = findDegenerate(scene);
    if (degenerate.empty()) return;
    if (choice == OnDegenerate::drop) return dropTriangles(scene, degenerate);
    const Scene::PrimitiveId id = scene.primitiveId(degenerate.front());
    throw Error(ErrorKind::invalid,
                counted(degenerate.size(), "triangle") + " of zero area; the first is triangle " +
                    std::to_string(id.primitive) + " of geometry " + std::to_string(id.geometry) + " '" +
                    scene.geometries[id.geometry].name + "': use --on-degenerate keep or drop");
}

}  // namespace

Scene flatten(ImportedScene imported, const ImportOptions& options) {
    refuseWithoutTriangles(imported);
    for (size_t i = 0; i < imported.meshes.size(); ++i) checkAndCompact(imported.meshes[i], uint32_t(i));
    uint64_t vertexCount = 0, triangleCount = 0;
    const std::vector<Placement> placements = planPlacements(imported, vertexCount, triangleCount);

    Scene scene;
    scene.geometries.reserve(imported.instances.size());
    for (size_t i = 0; i < imported.instances.size(); ++i) {
        const Instance& instance = imported.instances[i];
        const Mesh& mesh = imported.meshes[instance.mesh];
        scene.geometries.push_back({instance.name.empty() ? mesh.name : instance.name,
                                    uint32_t(placements[i].firstTriangle), uint32_t(mesh.triangles.size())});
    }
    if (imported.instances.size() == 1 && imported.instances[0].transform == kIdentityTransform) {
        // A single mesh in its own place, as in all files but glTF: nothing is copied.
        Mesh& mesh = imported.meshes[imported.instances[0].mesh];
        for (Vec3& v : mesh.vertices) v = v + Vec3{};  // -0 + 0 is +0
        scene.vertices = std::move(mesh.vertices);
        scene.triangles = std::move(mesh.triangles);
    } else {
        AlignedVector<Vec3> vertices(vertexCount);
        AlignedVector<TriangleIndices> triangles(triangleCount);
        placeAll(imported, placements, vertices, triangles);
        scene.vertices = std::move(vertices);
        scene.triangles = std::move(triangles);
    }
    imported = {};
    treatDegenerate(scene, options.onDegenerate);
    return scene;
}

}  // namespace bvhio
