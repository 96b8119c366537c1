// Where the instances of a scene enter the BLASes of its meshes.
#pragma once

#include <vector>

#include "compress/root_places.h"
#include "scene/instanced_bvh.h"

namespace bvhio {

/// What instances need to be entered, in the order of the top level's leaves.
struct PlacedBlases {
    SharedArray<uint32_t> instances;     // which instance of the scene the entry is
    std::vector<InstanceEntry> entries;  // from the scene, so not stored again
    std::vector<Aabb> meshBounds;        // the boxes of BLASes' roots
    std::vector<PrimitiveRange> runs;    // where BLASes are runs: the meshes' triangles; else empty

    PlacedBlases() = default;
    PlacedBlases(const Scene& scene, SharedArray<uint32_t> leafOrder, bool areRuns);
    bool empty() const { return entries.empty(); }
    size_t bytes() const {
        return entries.size() * (sizeof(InstanceEntry) + sizeof(uint32_t)) +
               meshBounds.size() * sizeof(Aabb) + runs.size() * sizeof(PrimitiveRange);
    }
    /// Of the BLASes' roots.
    RootPlaces places() const;
};

}  // namespace bvhio
