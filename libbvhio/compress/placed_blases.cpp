#include "compress/placed_blases.h"

namespace bvhio {

PlacedBlases::PlacedBlases(const Scene& scene, SharedArray<uint32_t> leafOrder, bool areRuns)
    : instances(std::move(leafOrder)), meshBounds(scene.meshes.size()) {
    const std::vector<InstanceEntry> all = instanceEntries(scene);
    for (const uint32_t instance : instances) entries.push_back(all[instance]);
    for (size_t i = 0; i < meshBounds.size(); ++i) meshBounds[i] = scene.boundsOf(scene.meshes[i]);
    if (areRuns)
        for (const SceneMesh& mesh : scene.meshes) runs.push_back({mesh.firstTriangle, mesh.triangleCount});
}

RootPlaces PlacedBlases::places() const {
    RootPlaces places{{}, meshBounds, std::vector<InsetBox>(meshBounds.size()), runs};
    for (const Aabb& box : meshBounds) places.frames.emplace_back(box);
    return places;
}

}  // namespace bvhio
