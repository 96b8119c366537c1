// Makes scenes from the caller's arrays.
#include "api/scene.h"

#include <cstring>
#include <limits>

#include "api/status.h"
#include "core/error.h"
#include "scene/scene_arrays.h"

namespace bvhio {
namespace {

/// Returns an array that may be absent: NULL with a count of 0.
template <class T>
std::span<const T> optionalArray(const T* values, uint64_t count, const char* name) {
    if (values == nullptr && count > 0)
        throw Error(ErrorKind::usage,
                    std::string(name) + " is NULL, but its count is " + std::to_string(count));
    return {values, values == nullptr ? 0 : size_t(count)};
}

SceneArrays arraysFrom(const BvhioSceneArrays& given, std::vector<SceneArrays::Part>& parts,
                       std::vector<SceneArrays::Placed>& placements) {
    SceneArrays arrays;
    if (given.triangleCount == 0) throw Error(ErrorKind::invalid, "the scene has no triangles");
    if (given.triangleCount > kMaxPrimitives)
        throw Error(ErrorKind::unsupported,
                    "the scene has more than " + std::to_string(kMaxPrimitives) + " triangles");
    requirePointer(given.vertices, "vertices");
    requirePointer(given.indices, "indices");
    arrays.vertices = given.vertices;
    arrays.vertexCount = size_t(given.vertexCount);
    if (given.vertexStride != 0) arrays.vertexStride = size_t(given.vertexStride);
    arrays.indices = {given.indices, size_t(given.triangleCount) * 3};
    if (given.sourceIds != nullptr) arrays.sourcePrimitives = {given.sourceIds, size_t(given.triangleCount)};
    for (const BvhioPart& part : optionalArray(given.parts, given.partCount, "parts"))
        parts.push_back({part.name == nullptr ? "" : part.name, part.triangleCount});
    if (given.parts != nullptr && given.partCount == 0)
        throw Error(ErrorKind::usage, "partCount is 0, but parts is not NULL: pass NULL for a single part");
    arrays.geometries = parts;
    arrays.meshes = optionalArray(given.meshes, given.meshCount, "meshes");
    for (const BvhioPlacement& from : optionalArray(given.placements, given.placementCount, "placements")) {
        SceneArrays::Placed placed{from.mesh, {}};
        std::memcpy(placed.objectToWorld.data(), from.objectToWorld, sizeof from.objectToWorld);
        placements.push_back(placed);
    }
    arrays.instances = placements;
    return arrays;
}

}  // namespace
}  // namespace bvhio

using namespace bvhio;

extern "C" {

BvhioStatus bvhioCreateScene(const BvhioSceneArrays* arrays, BvhioScene** scene) {
    return guarded([&] {
        requirePointer(scene, "scene");
        *scene = nullptr;
        requirePointer(arrays, "arrays");
        std::vector<SceneArrays::Part> parts;
        std::vector<SceneArrays::Placed> placements;
        *scene = new BvhioScene{sceneFromArrays(arraysFrom(*arrays, parts, placements))};
    });
}

void bvhioDestroyScene(BvhioScene* scene) {
    delete scene;
}
}
