// Object median splits (Kay and Kajiya 1986): halves the triangles by centroid along the longest axis of the
// box of their centroids. Our departure: centroids are ordered by (value, triangle id), so that equal
// centroids are also halved, and the depth stays at log2 of the triangle count.

#include "build/median.h"

#include <algorithm>
#include <numeric>

namespace bvhio {
namespace {

struct MedianBuild {
    const std::vector<Aabb>& boxes;
    const std::vector<Vec3>& centroids;
    uint32_t maxLeafSize;
    Progress* progress;
    AlignedVector<Node>& nodes;
    std::vector<uint32_t>& order;

    void split(uint32_t nodeIndex, uint32_t first, uint32_t count) {
        Aabb box = Aabb::empty(), centroidBox = Aabb::empty();
        for (uint32_t i = first; i < first + count; ++i) {
            box.extend(boxes[order[i]]);
            centroidBox.extend(centroids[order[i]]);
        }
        nodes[nodeIndex] = {box, first, count};
        if (count <= maxLeafSize) {
            if (progress) progress->add(count);
            return;
        }

        const int axis = centroidBox.longestAxis();
        const uint32_t half = count / 2;
        std::nth_element(order.begin() + first, order.begin() + first + half, order.begin() + first + count,
                         [&](uint32_t a, uint32_t b) {
                             const float ca = centroids[a][axis], cb = centroids[b][axis];
                             return ca != cb ? ca < cb : a < b;
                         });
        // The order that nth_element leaves in each half depends on the library. Ascending ids do not.
        std::sort(order.begin() + first, order.begin() + first + half);
        std::sort(order.begin() + first + half, order.begin() + first + count);

        const auto left = uint32_t(nodes.size());
        nodes.resize(nodes.size() + 2);
        nodes[nodeIndex].first = left;
        nodes[nodeIndex].primitiveCount = 0;
        split(left, first, half);
        split(left + 1, first + half, count - half);
    }
};

}  // namespace

Bvh buildMedian(const Scene& scene, const BuildOptions& options) {
    const size_t count = scene.triangles.size();
    std::vector<Aabb> boxes(count);
    std::vector<Vec3> centroids(count);
    for (size_t i = 0; i < count; ++i) {
        boxes[i] = bounds(scene.triangle(i));
        centroids[i] = boxes[i].center();
    }
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);

    AlignedVector<Node> nodes(2);
    nodes[1] = {};
    if (options.progress) options.progress->start(count);
    MedianBuild{boxes, centroids, options.maxLeafSize, options.progress, nodes, order}.split(0, 0,
                                                                                             uint32_t(count));
    return {std::move(nodes), std::move(order)};
}

}  // namespace bvhio
