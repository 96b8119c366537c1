// Merkle trees (Merkle 1987) with a symmetric combination: the hashes of children are combined in ascending
// order.

#include "stats/hashes.h"

#include <algorithm>
#include <array>

#include "core/hash.h"

namespace bvhio {
namespace {

template <class Function>
std::vector<uint64_t> hashBottomUp(const Bvh& bvh, const Function& hashNode) {
    std::vector<uint64_t> hashes(bvh.nodes.size());
    std::vector<uint32_t> triangles;
    for (size_t i = bvh.nodes.size(); i-- > 0;) {
        if (i == 1) continue;  // the unused slot beside the root
        const Node& node = bvh.nodes[i];
        uint64_t content;
        if (node.isLeaf()) {
            const auto* first = bvh.primitives.data() + node.first;
            triangles.assign(first, first + node.primitiveCount);
            std::sort(triangles.begin(), triangles.end());
            content = hash64(std::as_bytes(std::span(triangles)));
        } else {
            // No leaf can hash the same bytes, because they would start with triangles beyond 2^31.
            constexpr uint64_t kInner = ~uint64_t(0);
            const auto [low, high] = std::minmax(hashes[node.left()], hashes[node.right()]);
            const std::array words{kInner, low, high};
            content = hash64(std::as_bytes(std::span(words)));
        }
        hashes[i] = hashNode(node, content);
    }
    return hashes;
}

}  // namespace

std::vector<uint64_t> topologyHashes(const Bvh& bvh) {
    return hashBottomUp(bvh, [](const Node&, uint64_t content) { return content; });
}

std::vector<uint64_t> boundsHashes(const Bvh& bvh) {
    return hashBottomUp(bvh, [](const Node& node, uint64_t content) {
        const std::array words{hash64(std::as_bytes(std::span(&node.bounds, 1))), content};
        return hash64(std::as_bytes(std::span(words)));
    });
}

uint64_t geometryHash(const Scene& scene) {
    Hasher hasher;
    // Each part is preceded by its size, so that bytes of one part cannot be taken for those of the next.
    const auto add = [&](const auto& part) {
        const uint64_t size = part.size();
        hasher.update(std::as_bytes(std::span(&size, 1)));
        hasher.update(std::as_bytes(std::span(part.data(), part.size())));
    };
    add(scene.vertices);
    add(scene.triangles);
    for (const Geometry& geometry : scene.geometries) {
        add(std::array{geometry.firstTriangle, geometry.triangleCount});
        add(geometry.name);
    }
    add(scene.sourcePrimitives);
    if (scene.isInstanced()) {
        for (const SceneMesh& mesh : scene.meshes) add(std::array{mesh.geometryCount});
        add(scene.instances);
    }
    return hasher.value();
}

}  // namespace bvhio
