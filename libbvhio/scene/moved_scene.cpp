#include "scene/moved_scene.h"

#include "core/error.h"

namespace bvhio {
namespace {

Error notTheSame(const std::string& what) {
    return {ErrorKind::invalid, what + ": a refit needs the same triangles, which share the same vertices"};
}

std::string counts(uint64_t moved, uint64_t old, const std::string& of) {
    return std::to_string(moved) + " " + of + ", but the tree has " + std::to_string(old);
}

std::string nameOf(const Scene& scene, uint32_t triangle) {
    const Scene::PrimitiveId id = scene.primitiveId(triangle);
    return "triangle " + std::to_string(id.primitive) + " of geometry " + std::to_string(id.geometry);
}

/// Returns the number in `moved` of each triangle of `old`.
std::vector<uint32_t> matchTriangles(const Scene& old, const Scene& moved) {
    if (moved.geometries.size() != old.geometries.size())
        throw notTheSame(counts(moved.geometries.size(), old.geometries.size(), "geometries"));
    std::vector<uint32_t> numbers(old.triangles.size());
    for (size_t g = 0; g < old.geometries.size(); ++g) {
        const Geometry &from = old.geometries[g], &to = moved.geometries[g];
        const std::string where = "geometry " + std::to_string(g) + " has ";
        if (old.sourcePrimitives.empty() && to.triangleCount != from.triangleCount)
            throw notTheSame(where + counts(to.triangleCount, from.triangleCount, "triangles"));
        for (uint32_t i = from.firstTriangle; i < from.firstTriangle + from.triangleCount; ++i) {
            const uint32_t number =
                old.sourcePrimitives.empty() ? i - from.firstTriangle : old.sourcePrimitives[i];
            if (number >= to.triangleCount)
                throw notTheSame(where + std::to_string(to.triangleCount) +
                                 " triangles, but the tree refers to triangle " + std::to_string(number));
            numbers[i] = to.firstTriangle + number;
        }
    }
    return numbers;
}

/// Checks that each vertex of `old` has one counterpart in `moved`, and no two vertices have the same one.
class Renumbering {
  public:
    Renumbering(size_t oldCount, size_t movedCount) : movedOf_(oldCount, kNone), oldOf_(movedCount, kNone) {}

    bool agrees(uint32_t old, uint32_t moved) {
        if (movedOf_[old] == kNone) movedOf_[old] = moved;
        if (oldOf_[moved] == kNone) oldOf_[moved] = old;
        return movedOf_[old] == moved && oldOf_[moved] == old;
    }

  private:
    static constexpr uint32_t kNone = 0xFFFFFFFF;
    std::vector<uint32_t> movedOf_, oldOf_;
};

}  // namespace

Scene movedScene(const Scene& old, const Scene& moved) {
    const std::vector<uint32_t> numbers = matchTriangles(old, moved);
    Renumbering vertices(old.vertices.size(), moved.vertices.size());
    AlignedVector<TriangleIndices> triangles(numbers.size());
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        const TriangleIndices &a = old.triangles[i], &b = moved.triangles[numbers[i]];
        if (!vertices.agrees(a.v0, b.v0) || !vertices.agrees(a.v1, b.v1) || !vertices.agrees(a.v2, b.v2))
            throw notTheSame(nameOf(old, i) + " shares vertices with other triangles than in the tree");
        triangles[i] = b;
    }
    std::vector<Geometry> geometries = old.geometries;
    for (size_t g = 0; g < geometries.size(); ++g) geometries[g].name = moved.geometries[g].name;
    return {moved.vertices, std::move(triangles), std::move(geometries), old.sourcePrimitives};
}

}  // namespace bvhio
