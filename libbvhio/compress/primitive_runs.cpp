#include "compress/primitive_runs.h"

#include <algorithm>

#include "core/buffer.h"

namespace bvhio {
namespace {

/// Returns the number of primitives below a node if its subtree has the shape of an MVH, otherwise 0.
uint32_t countOfMvh(const NibbleRuns& shape, const Forest& forest, const Node& node) {
    if (node.isLeaf()) return shape.root({0, node.primitiveCount}).isLeaf() ? node.primitiveCount : 0;
    const uint32_t left = countOfMvh(shape, forest, forest.nodes[node.left()]);
    const uint32_t right = left == 0 ? 0 : countOfMvh(shape, forest, forest.nodes[node.right()]);
    const NibbleRun run = shape.root({0, left + right});
    return right != 0 && !run.isLeaf() && shape.left(run).count == left ? run.count : 0;
}

}  // namespace

Runs gatherRuns(const Scene& scene, const Forest& forest, std::span<const uint32_t> primitives,
                const NibbleRuns& shape) {
    Runs runs;
    runs.primitives.reserve(primitives.size());
    runs.boxes.reserve(primitives.size());
    std::vector<Node> waiting;
    for (const Node& root : forest.roots) {
        const auto first = uint32_t(runs.primitives.size());
        waiting = {root};
        while (!waiting.empty()) {
            const Node node = waiting.back();
            waiting.pop_back();
            if (!node.isLeaf()) {
                waiting.push_back(forest.nodes[node.right()]);
                waiting.push_back(forest.nodes[node.left()]);
                continue;
            }
            for (const uint32_t primitive : primitives.subspan(node.first, node.primitiveCount)) {
                Aabb box = bounds(scene.triangle(primitive));
                for (int axis = 0; axis < 3; ++axis) {
                    box.min[axis] = std::max(box.min[axis], node.bounds.min[axis]);
                    box.max[axis] = std::min(box.max[axis], node.bounds.max[axis]);
                }
                runs.primitives.push_back(primitive);
                runs.boxes.push_back(box);
            }
        }
        runs.ranges.push_back({first, uint32_t(runs.primitives.size()) - first});
    }
    runs.ordered.resize(runs.primitives.size());
    for (size_t i = 0; i < runs.ranges.size(); ++i)
        runs.ordered[runs.ranges[i].first] = countOfMvh(shape, forest, forest.roots[i]);
    return runs;
}

Bvh withRuns(const Bvh& top, const Runs& runs) {
    Buffer<Node> nodes(top.nodes.size());
    for (size_t i = 0; i < nodes.size(); ++i) {
        const Node& node = top.nodes[i];
        nodes[i] = node;
        if (node.isLeaf())
            nodes[i] = {node.bounds, runs.ranges[node.first].first, runs.ranges[node.first].count};
    }
    return {std::move(nodes).share(), std::vector<uint32_t>(runs.primitives)};
}

}  // namespace bvhio
