#include "stats/diff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <optional>

#include "core/report.h"
#include "stats/hashes.h"
#include "stats/stats_report.h"
#include "stats/tree_stats.h"

namespace bvhio {
namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
    char buffer[160];
    std::snprintf(buffer, sizeof buffer, pattern, values...);
    return buffer;
}
std::string text(Vec3 p) {
    return format("(%.9g, %.9g, %.9g)", double(p.x), double(p.y), double(p.z));
}
std::string text(const Aabb& box) {
    return text(box.min) + " to " + text(box.max);
}
std::string text(const TriangleIndices& t) {
    return format("(%u, %u, %u)", t.v0, t.v1, t.v2);
}
std::string text(uint32_t number) {
    return std::to_string(number);
}
std::string text(const SceneMesh& mesh) {
    return format("%u geometries from %u", mesh.geometryCount, mesh.firstGeometry);
}
std::string text(const SceneInstance& instance) {
    std::string result = format("mesh %u by", instance.mesh);
    for (const float number : instance.objectToWorld) result += format(" %.9g", double(number));
    return result;
}
std::string text(const Geometry& g) {
    std::string result = "'";
    return result.append(g.name).append(
        format("' of %u triangles from %u", g.triangleCount, g.firstTriangle));
}

/// Counts differences, and describes the first one.
class ArrayDiff {
  public:
    /// Compares two arrays element by element. If their sizes differ, notes only that.
    template <class Array>
    void compare(const std::string& element, const std::string& elements, const Array& a, const Array& b) {
        if (a.size() != b.size())
            return note([&] { return format("%zu and %zu ", a.size(), b.size()) + elements; });
        for (size_t i = 0; i < a.size(); ++i)
            if (!(a[i] == b[i]))
                note([&] { return element + format(" %zu: ", i) + text(a[i]) + " and " + text(b[i]); });
    }
    template <class Describe>
    void note(const Describe& describe) {
        if (count_++ == 0) first_ = describe();
    }
    std::optional<Difference> result(Aspect aspect) const {
        if (count_ == 0) return {};
        return Difference{aspect, first_, count_};
    }

  private:
    std::string first_;
    uint64_t count_ = 0;
};

std::optional<Difference> geometryDifference(const Scene& a, const Scene& b) {
    ArrayDiff diff;
    diff.compare("vertex", "vertices", a.vertices, b.vertices);
    diff.compare("triangle", "triangles", a.triangles, b.triangles);
    diff.compare("geometry", "geometries", a.geometries, b.geometries);
    diff.compare("source number of triangle", "source numbers", a.sourcePrimitives, b.sourcePrimitives);
    diff.compare("mesh", "meshes", a.meshes, b.meshes);
    diff.compare("instance", "instances", a.instances, b.instances);
    return diff.result(Aspect::geometry);
}

std::optional<Difference> costsDifference(const SahCosts& a, const SahCosts& b) {
    ArrayDiff diff;
    const auto compare = [&](const char* name, float costA, float costB) {
        if (costA != costB)
            diff.note([&] { return name + format(" cost: %.6g and %.6g", double(costA), double(costB)); });
    };
    compare("traversal", a.traversal, b.traversal);
    compare("intersection", a.intersection, b.intersection);
    return diff.result(Aspect::costs);
}

std::string describe(const Bvh& bvh, uint32_t node) {
    const uint32_t count = bvh.nodes[node].primitiveCount;
    return bvh.nodes[node].isLeaf() ? format("node %u (a leaf of %u)", node, count) : format("node %u", node);
}

/// Returns the number of nodes of `a` whose hash no node of `b` has. Equal hashes count as often as they are
/// missing.
uint64_t missingFrom(std::vector<uint64_t> a, std::vector<uint64_t> b) {
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    std::vector<uint64_t> missing;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(missing));
    return missing.size();
}

/// A decoded tree and the hashes of its subtrees.
struct Side {
    explicit Side(const EncodedBvh& encoded)
        : bvh(std::visit([](const auto& form) { return form.decode(); }, encoded)),
          topology(topologyHashes(bvh)) {}
    Bvh bvh;
    std::vector<uint64_t> topology;
};

/// Describes a difference of topologies at the lowest pair of nodes below which all differences are.
Difference topologyDifference(const Side& a, const Side& b) {
    uint32_t nodeA = 0, nodeB = 0, depth = 0;
    for (;; ++depth) {
        const Node &inA = a.bvh.nodes[nodeA], &inB = b.bvh.nodes[nodeB];
        if (inA.isLeaf() || inB.isLeaf()) break;
        bool descends = false;
        for (const int sideA : {0, 1})
            for (const int sideB : {0, 1}) {
                if (descends || a.topology[inA.first + sideA] != b.topology[inB.first + sideB]) continue;
                nodeA = inA.first + (1 - sideA);
                nodeB = inB.first + (1 - sideB);
                descends = true;
            }
        if (!descends) break;
    }
    return {Aspect::topology,
            describe(a.bvh, nodeA) + " and " + describe(b.bvh, nodeB) +
                format(" at depth %u group triangles differently", depth),
            missingFrom(a.topology, b.topology)};
}

/// Walks two trees of the same topology side by side. Siblings are matched by their topology hashes.
std::optional<Difference> boxDifference(const Side& a, const Side& b) {
    std::vector<std::array<uint32_t, 2>> open{std::array{0u, 0u}};
    ArrayDiff diff;
    while (!open.empty()) {
        const auto [nodeA, nodeB] = open.back();
        open.pop_back();
        const Node &inA = a.bvh.nodes[nodeA], &inB = b.bvh.nodes[nodeB];
        if (inA.bounds != inB.bounds)
            diff.note([&, a0 = nodeA, b0 = nodeB] {
                return describe(a.bvh, a0) + " and " + describe(b.bvh, b0) + ": " + text(inA.bounds) +
                       " and " + text(inB.bounds);
            });
        if (inA.isLeaf()) continue;
        const bool isSwapped = a.topology[inA.left()] != b.topology[inB.left()];
        open.push_back({inA.right(), isSwapped ? inB.left() : inB.right()});
        open.push_back({inA.left(), isSwapped ? inB.right() : inB.left()});
    }
    return diff.result(Aspect::boxes);
}

/// Compares the topologies of nodes slot by slot, without boxes, and then the leaves' entries.
std::optional<Difference> orderDifference(const Side& a, const Side& b) {
    ArrayDiff diff;
    for (uint32_t i = 0; i < a.bvh.nodes.size(); ++i)
        if (a.topology[i] != b.topology[i] || a.bvh.nodes[i].first != b.bvh.nodes[i].first)
            diff.note([&] { return describe(a.bvh, i) + " and " + describe(b.bvh, i) + " in its place"; });
    diff.compare("leaf entry", "leaf entries", a.bvh.primitives, b.bvh.primitives);
    return diff.result(Aspect::order);
}

std::vector<Difference> differences(const DiffSide& inputA, const Side& a, const DiffSide& inputB,
                                    const Side& b) {
    std::vector<Difference> result;
    const auto add = [&](std::optional<Difference>&& difference) {
        if (difference) result.push_back(std::move(*difference));
    };
    if (inputA.encoded.index() != inputB.encoded.index())
        result.push_back(
            {Aspect::form,
             std::string(formNameOf(inputA.encoded)).append(" and ").append(formNameOf(inputB.encoded)),
             a.bvh.nodeCount()});
    add(costsDifference(inputA.costs, inputB.costs));
    if (a.topology[0] == b.topology[0]) {
        add(orderDifference(a, b));
        add(boxDifference(a, b));
    } else {
        result.push_back(topologyDifference(a, b));
    }
    add(geometryDifference(inputA.scene, inputB.scene));
    return result;
}

Report sideReport(const DiffSide& input, const Side& side) {
    Report report;
    report["form"] = formNameOf(input.encoded);
    report["layout"] = layoutName(side.bvh);
    report["primitives"] = input.scene.triangles.size();
    report["nodes"] = side.bvh.nodeCount();
    report["sah_cost"] = sahCost(side.bvh, input.costs);
    report["topology_hash"] = hashText(side.topology[0]);
    report["bounds_hash"] = hashText(boundsHash(side.bvh));
    report["geometry_hash"] = hashText(geometryHash(input.scene));
    return report;
}

/// Returns the largest distance between vertices of the same index, as after a lossy round trip.
double largestShift(const SharedArray<Vec3>& a, const SharedArray<Vec3>& b) {
    double largest = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        const double x = double(b[i].x) - a[i].x, y = double(b[i].y) - a[i].y, z = double(b[i].z) - a[i].z;
        largest = std::max(largest, std::sqrt(x * x + y * y + z * z));
    }
    return largest;
}

}  // namespace

std::string_view nameOf(Aspect aspect) {
    constexpr std::string_view kNames[] = {"form", "costs", "order", "boxes", "topology", "geometry"};
    return kNames[size_t(aspect)];
}

std::vector<Difference> differences(const DiffSide& a, const DiffSide& b) {
    return differences(a, Side(a.encoded), b, Side(b.encoded));
}

Report diffReport(const DiffSide& a, const DiffSide& b) {
    const Side sideA(a.encoded), sideB(b.encoded);
    const std::vector<Difference> found = differences(a, sideA, b, sideB);
    Report report;
    report["verdict"] = found.empty() ? "identical" : nameOf(found.back().aspect);
    report["differences"] = Report::array();
    for (const Difference& difference : found)
        report["differences"].push_back({{"aspect", nameOf(difference.aspect)},
                                         {"first", difference.first},
                                         {"count", difference.count}});
    report["shared_subtrees"] = sideA.bvh.nodeCount() - missingFrom(sideA.topology, sideB.topology);
    if (a.scene.vertices.size() == b.scene.vertices.size())
        report["largest_shift"] = largestShift(a.scene.vertices, b.scene.vertices);
    else
        report["largest_shift"] = nullptr;
    report["a"] = sideReport(a, sideA);
    report["b"] = sideReport(b, sideB);
    return report;
}

}  // namespace bvhio
