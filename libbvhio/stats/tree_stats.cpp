#include "stats/tree_stats.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "core/report.h"
#include "tree/depth.h"

namespace bvhio {
namespace {

/// Returns the half area that the boxes of two siblings share. It is 0 for boxes that only touch, but boxes
/// that are flat on the same axis may share some.
double sharedHalfArea(const Aabb& a, const Aabb& b) {
    const Aabb shared{max(a.min, b.min), min(a.max, b.max)};
    if (shared.isEmpty()) return 0;
    for (int axis = 0; axis < 3; ++axis) {
        const bool isFlat = a.min[axis] == a.max[axis] || b.min[axis] == b.max[axis];
        if (!isFlat && shared.min[axis] == shared.max[axis]) return 0;
    }
    return halfArea(shared);
}

void count(std::vector<uint64_t>& histogram, size_t value) {
    if (histogram.size() <= value) histogram.resize(value + 1);
    ++histogram[value];
}

void add(std::vector<uint64_t>& histogram, const std::vector<uint64_t>& other) {
    if (histogram.size() < other.size()) histogram.resize(other.size());
    for (size_t value = 0; value < other.size(); ++value) histogram[value] += other[value];
}

Report histogramReport(const std::vector<uint64_t>& histogram) {
    Report report = Report::object();
    for (size_t value = 0; value < histogram.size(); ++value)
        if (histogram[value] > 0) report[std::to_string(value)] = histogram[value];
    return report;
}

/// Returns the double with the same shortest text as the float: 1.2, not 1.2000000476837158.
double asWritten(float value) {
    char digits[32];
    const char* end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    double result = 0;
    std::from_chars(digits, end, result);
    return result;
}

}  // namespace

TreeStats treeStats(const Bvh& bvh, const SahCosts& costs) {
    TreeStats stats;
    stats.references = bvh.primitives.size();
    stats.nodes = bvh.nodeCount();
    stats.costs = costs;
    stats.sahCost = sahCost(bvh, costs);

    const double rootArea = halfArea(bvh.nodes[0].bounds);
    double innerArea = 0, sharedArea = 0, sumOfDepths = 0;
    const std::vector<uint32_t> depths = depthsOfPairs(bvh);
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        if (i == 1) continue;  // the unused slot beside the root
        const Node& node = bvh.nodes[i];
        const double area = halfArea(node.bounds);
        const double probability = rootArea > 0 ? area / rootArea : 1;  // as in sahCost
        if (node.isLeaf()) {
            ++stats.leaves;
            stats.expectedLeaves += probability;
            stats.expectedTriangles += probability * node.primitiveCount;
            sumOfDepths += depths[i / 2];
            count(stats.leafDepths, depths[i / 2]);
            count(stats.leafSizes, node.primitiveCount);
        } else {
            ++stats.innerNodes;
            stats.expectedInnerNodes += probability;
            innerArea += area;
            sharedArea += sharedHalfArea(bvh.nodes[node.left()].bounds, bvh.nodes[node.right()].bounds);
        }
    }
    stats.maxDepth = uint32_t(stats.leafDepths.size()) - 1;
    stats.averageLeafDepth = sumOfDepths / double(stats.leaves);
    stats.childOverlap = innerArea > 0 ? sharedArea / innerArea : 0;
    return stats;
}

TreeStats treeStats(const Scene& scene, const InstancedBvh& bvh, const SahCosts& costs) {
    TreeStats stats = treeStats(bvh.top, costs);
    std::vector<double> entered(bvh.meshes.size());  // expected instances of each mesh that a line enters
    const double rootArea = halfArea(bvh.top.nodes[0].bounds);
    for (size_t i = 0; i < bvh.top.nodes.size(); ++i) {
        const Node& leaf = bvh.top.nodes[i];
        if (!leaf.isLeaf()) continue;
        entered[scene.instances[bvh.top.primitives[leaf.first]].mesh] +=
            rootArea > 0 ? halfArea(leaf.bounds) / rootArea : 1;
    }
    stats.references = stats.leaves = 0;
    stats.expectedLeaves = stats.expectedTriangles = 0;
    stats.leafDepths.clear();
    stats.leafSizes.clear();
    double depths = 0;
    for (size_t i = 0; i < bvh.meshes.size(); ++i) {
        const TreeStats mesh = treeStats(bvh.meshes[i], costs);
        stats.references += mesh.references;
        stats.nodes += mesh.nodes;
        stats.innerNodes += mesh.innerNodes;
        stats.leaves += mesh.leaves;
        stats.maxDepth = std::max(stats.maxDepth, mesh.maxDepth);
        depths += mesh.averageLeafDepth * double(mesh.leaves);
        stats.expectedInnerNodes += entered[i] * mesh.expectedInnerNodes;
        stats.expectedLeaves += entered[i] * mesh.expectedLeaves;
        stats.expectedTriangles += entered[i] * mesh.expectedTriangles;
        add(stats.leafDepths, mesh.leafDepths);
        add(stats.leafSizes, mesh.leafSizes);
    }
    stats.averageLeafDepth = depths / double(stats.leaves);
    stats.sahCost = double(costs.traversal) * stats.expectedInnerNodes +
                    double(costs.intersection) * stats.expectedTriangles;
    return stats;
}

double sahCost(const Scene& scene, const EncodedBvh& bvh, const SahCosts& costs) {
    if (!isInstanced(bvh)) return sahCost(decode(bvh), costs);
    return treeStats(scene, std::get<TwoLevelForm>(bvh).decodeInstances(scene), costs).sahCost;
}

void addTo(Report& report, const TreeStats& stats) {
    report["references"] = stats.references;
    report["nodes"] = stats.nodes;
    report["inner_nodes"] = stats.innerNodes;
    report["leaves"] = stats.leaves;
    report["max_depth"] = stats.maxDepth;
    report["average_leaf_depth"] = stats.averageLeafDepth;
    report["sah_cost"] = stats.sahCost;
    report["traversal_cost"] = asWritten(stats.costs.traversal);
    report["intersection_cost"] = asWritten(stats.costs.intersection);
    report["expected"] = {{"inner_nodes", stats.expectedInnerNodes},
                          {"leaves", stats.expectedLeaves},
                          {"triangles", stats.expectedTriangles}};
    report["child_overlap"] = stats.childOverlap;
    report["leaf_depths"] = histogramReport(stats.leafDepths);
    report["leaf_sizes"] = histogramReport(stats.leafSizes);
}

namespace {

/// Returns whether pairs are in order level by level: then they are in the order of their parents.
bool isBreadthFirst(const Bvh& bvh) {
    uint32_t next = 2;
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        if (i == 1 || bvh.nodes[i].isLeaf()) continue;
        if (bvh.nodes[i].first != next) return false;
        next += 2;
    }
    return true;
}

/// Returns "dfs", "odfs" or "depth-first", or "" if pairs are not in depth-first order.
std::string_view depthFirstName(const Bvh& bvh) {
    // The same weights as in odfs, so that ties are the same.
    const double rootArea = halfArea(bvh.nodes[0].bounds);
    const auto weight = [&](const Node& node) { return rootArea > 0 ? halfArea(node.bounds) / rootArea : 1; };
    bool leftFirst = true, largerFirst = true;
    uint32_t next = 2;
    std::vector<uint32_t> open{0};
    while (!open.empty()) {
        const Node& parent = bvh.nodes[open.back()];
        open.pop_back();
        if (parent.isLeaf()) continue;
        if (parent.first != next) return "";
        next += 2;
        const Node &left = bvh.nodes[parent.left()], &right = bvh.nodes[parent.right()];
        const bool isRightFirst = !left.isLeaf() && !right.isLeaf() && right.first == next;
        if (!left.isLeaf() && !right.isLeaf()) {
            leftFirst &= !isRightFirst;
            largerFirst &= isRightFirst == (weight(right) > weight(left));
        }
        open.push_back(isRightFirst ? parent.left() : parent.right());
        open.push_back(isRightFirst ? parent.right() : parent.left());
    }
    return leftFirst ? "dfs" : largerFirst ? "odfs" : "depth-first";
}

}  // namespace

std::string_view layoutName(const Bvh& bvh) {
    if (!bvh.slots.empty()) return "clusters";
    if (const std::string_view name = depthFirstName(bvh); !name.empty()) return name;
    return isBreadthFirst(bvh) ? "bfs" : "other";
}

}  // namespace bvhio
