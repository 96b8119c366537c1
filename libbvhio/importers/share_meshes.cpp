// From an imported scene to an instanced one: parts that stand together become meshes, each once.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.h"
#include "importers/import.h"

namespace bvhio {

namespace {

/// The most that a transform may magnify the rounding of a ray's direction on any axis. A factor of 256
/// leaves 16 exact bits, a small part of a pixel. Uniform scales, and scales along a mesh's own axes, magnify
/// hardly at all.
constexpr double kMaxSkew = 256;
/// The most that rays may grow or shrink: their coordinates must not leave the range of floats, nor lose
/// digits as denormals.
constexpr double kMaxScale = 0x1p40;
constexpr uint32_t kNoMesh = 0xFFFFFFFF;

Affine rounded(const Transform& transform) {
    Affine result;
    for (size_t i = 0; i < result.size(); ++i) result[i] = float(transform[i]) + 0.0f;  // -0 + 0 is +0
    return result;
}

/// The condition number of R. D. Skeel (1979), the largest row sum of |A| |A^-1|.
double skew(const Affine& affine, const WorldToObject& inverse) {
    double largest = 0;
    for (size_t row = 0; row < 3; ++row) {
        double sum = 0;
        for (size_t k = 0; k < 3; ++k)
            for (size_t column = 0; column < 3; ++column)
                sum += std::fabs(double(affine[4 * row + k]) * inverse.linear[3 * k + column]);
        largest = std::max(largest, sum);
    }
    return largest;
}

bool keepsRaysInRange(const WorldToObject& to) {
    for (size_t row = 0; row < 9; row += 3) {
        const double sum =
            std::fabs(to.linear[row]) + std::fabs(to.linear[row + 1]) + std::fabs(to.linear[row + 2]);
        if (!(sum >= 1 / kMaxScale && sum <= kMaxScale)) return false;
    }
    return true;
}

/// The imported meshes of instances that stand together: the parts of one mesh.
using Parts = std::vector<uint32_t>;

class MeshSharer {
  public:
    explicit MeshSharer(ImportedScene& imported) : imported_(imported) {
        boxes_.reserve(imported.meshes.size());
        for (const Mesh& mesh : imported.meshes) {
            Aabb box = Aabb::empty();
            for (const Vec3& v : mesh.vertices) box.extend(v);
            boxes_.push_back(box);
        }
    }

    /// Fills in the meshes, and the instances without the numbers of their primitives.
    void share() {
        const std::vector<Instance>& all = imported_.instances;
        uint64_t geometry = 0;
        for (size_t first = 0, end; first < all.size(); first = end) {
            Parts together{all[first].mesh};
            for (end = first + 1; end < all.size() && all[end].joinsPrevious; ++end)
                together.push_back(all[end].mesh);
            addPlace(together, first, geometry);
            geometry += end - first;
            if (geometry > std::numeric_limits<uint32_t>::max())
                throw Error(ErrorKind::unsupported, "the scene has more than 2^32 geometries");
        }
    }

    std::vector<SceneMesh> meshes;
    std::vector<SceneInstance> instances;
    std::vector<Instance> parts;  // of all meshes, each where it stands in its mesh

  private:
    void addPlace(const Parts& meshParts, size_t first, uint64_t geometry) {
        uint64_t triangles = 0;
        for (const uint32_t part : meshParts) triangles += imported_.meshes[part].triangles.size();
        if (triangles == 0) return;
        const Transform& transform = imported_.instances[first].transform;
        SceneInstance instance{rounded(transform), uint32_t(meshes.size()), 0, uint32_t(geometry)};
        if (!isUsable(instance.objectToWorld, meshParts)) {
            instance.objectToWorld = kIdentityAffine;
            addMesh(meshParts, first, transform);
        } else {
            const auto [known, isNew] = known_.try_emplace(meshParts, instance.mesh);
            if (isNew)
                addMesh(meshParts, first, kIdentityTransform);
            else
                instance.mesh = known->second;
        }
        instances.push_back(instance);
    }

    void addMesh(const Parts& meshParts, size_t first, const Transform& transform) {
        for (size_t i = 0; i < meshParts.size(); ++i)
            parts.push_back({meshParts[i], transform, imported_.instances[first + i].name});
        meshes.push_back({.geometryCount = uint32_t(meshParts.size())});
    }

    bool isUsable(const Affine& affine, const Parts& meshParts) const {
        const auto back = inverse(affine);
        if (!back || !keepsRaysInRange(*back) || !(skew(affine, *back) <= kMaxSkew)) return false;
        for (const uint32_t part : meshParts) {
            const Aabb box = placedBox(affine, boxes_[part]);
            for (int axis = 0; axis < 3; ++axis)
                if (box.min[axis] == -kLargest || box.max[axis] == kLargest) return false;
        }
        return true;
    }

    static constexpr float kLargest = std::numeric_limits<float>::max();
    ImportedScene& imported_;
    std::vector<Aabb> boxes_;
    std::map<Parts, uint32_t> known_;
};

/// Removes meshes whose triangles were all dropped, with their geometries and instances.
void leaveOutEmpty(Scene& scene) {
    std::vector<Geometry> geometries;
    std::vector<SceneMesh> meshes;
    std::vector<uint32_t> newNumber(scene.meshes.size());
    size_t geometry = 0;
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        const size_t end = geometry + scene.meshes[i].geometryCount;
        const bool hasTriangles = std::any_of(scene.geometries.begin() + ptrdiff_t(geometry),
                                              scene.geometries.begin() + ptrdiff_t(end),
                                              [](const Geometry& g) { return g.triangleCount > 0; });
        newNumber[i] = uint32_t(meshes.size());
        if (!hasTriangles) newNumber[i] = kNoMesh;
        for (; geometry < end; ++geometry)
            if (hasTriangles) geometries.push_back(std::move(scene.geometries[geometry]));
        if (hasTriangles) meshes.push_back(scene.meshes[i]);
    }
    std::erase_if(scene.instances, [&](const SceneInstance& i) { return newNumber[i.mesh] == kNoMesh; });
    for (SceneInstance& instance : scene.instances) instance.mesh = newNumber[instance.mesh];
    scene.geometries = std::move(geometries);
    scene.meshes = std::move(meshes);
}

}  // namespace

Scene shareMeshes(ImportedScene imported, const ImportOptions& options) {
    MeshSharer sharer(imported);
    sharer.share();
    imported.instances = std::move(sharer.parts);
    Scene scene = flatten(std::move(imported), options);
    scene.meshes = std::move(sharer.meshes);
    scene.instances = std::move(sharer.instances);
    leaveOutEmpty(scene);
    numberInstances(scene);
    return scene;
}

}  // namespace bvhio
