// The places of a scene's instances, by which rays enter the BLASes of its meshes.
#pragma once

#include <vector>

#include "compress/root_places.h"
#include "scene/instanced_bvh.h"

namespace bvhio {

/// The data by which rays enter instances, in the order of the top level's leaves.
struct PlacedBlases {
    SharedArray<uint32_t> instances;     // the scene's instance of each entry
    std::vector<InstanceEntry> entries;  // computed from the scene, so files do not store them
    std::vector<Aabb> meshBounds;        // the boxes of the BLASes' roots
    std::vector<PrimitiveRange> runs;    // of the meshes' triangles, if BLASes are runs; otherwise empty

    PlacedBlases() = default;
    PlacedBlases(const Scene& scene, SharedArray<uint32_t> leafOrder, bool areRuns);
    bool empty() const { return entries.empty(); }
    size_t bytes() const {
        return entries.size() * (sizeof(InstanceEntry) + sizeof(uint32_t)) +
               meshBounds.size() * sizeof(Aabb) + runs.size() * sizeof(PrimitiveRange);
    }
    /// Returns the places of the BLASes' roots.
    RootPlaces places() const;
};

}  // namespace bvhio
