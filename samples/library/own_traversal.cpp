// Traverses the decoded nodes of a .bvhx file's tree with its own code: counts the triangles near a point, and
// compares with a loop over all triangles. This works for files in any form, because compact forms are decoded.
#include <algorithm>
#include <array>
#include <bvhio.hpp>
#include <cstdio>
#include <vector>

namespace {

using Point = std::array<float, 3>;

struct Box {
    Point min, max;
};

bool meet(const Box& a, const float* min, const float* max) {
    for (size_t axis = 0; axis < 3; ++axis)
        if (a.max[axis] < min[axis] || a.min[axis] > max[axis]) return false;
    return true;
}

/// The box of a triangle in a plain scene.
Box boxOf(const bvhio::Container& container, uint32_t triangle) {
    const auto vertices = container.vertices();
    const auto& corners = container.triangles()[triangle];
    Box box{vertices[corners[0]], vertices[corners[0]]};
    for (const uint32_t corner : corners)
        for (size_t axis = 0; axis < 3; ++axis) {
            box.min[axis] = std::min(box.min[axis], vertices[corner][axis]);
            box.max[axis] = std::max(box.max[axis], vertices[corner][axis]);
        }
    return box;
}

/// Returns the triangles whose boxes overlap `query`, each once, in ascending order; counts nodes in `visited`.
std::vector<uint32_t> trianglesIn(const bvhio::Container& container, const Box& query, size_t& visited) {
    const bvhio::Tree tree = container.tree();
    std::vector<uint32_t> found, stack{0};
    while (!stack.empty()) {
        const bvhio::Node& node = tree.nodes[stack.back()];
        stack.pop_back();
        ++visited;
        if (!meet(query, node.min, node.max)) continue;
        if (node.count == 0) {
            stack.push_back(node.first);
            stack.push_back(node.first + 1);
            continue;
        }
        for (const uint32_t triangle : tree.primitives.subspan(node.first, node.count)) {
            const Box box = boxOf(container, triangle);
            if (meet(query, box.min.data(), box.max.data())) found.push_back(triangle);
        }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()),
                found.end());  // a split triangle is in several leaves
    return found;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: own_traversal FILE.bvhx\n"), 1;
    try {
        const bvhio::Container container = bvhio::Container::open(argv[1]);
        if (container.info().instanceCount > 0)
            return std::fprintf(stderr,
                                "own_traversal: the scene has instances: this sample is for plain ones\n"),
                   1;

        // A box around the middle of the scene, a tenth of its size.
        const bvhio::Node& root = container.tree().nodes[0];
        Box query;
        for (size_t axis = 0; axis < 3; ++axis) {
            const float middle = 0.5f * (root.min[axis] + root.max[axis]);
            const float reach = 0.05f * (root.max[axis] - root.min[axis]);
            query.min[axis] = middle - reach;
            query.max[axis] = middle + reach;
        }
        size_t visited = 0;
        const std::vector<uint32_t> found = trianglesIn(container, query, visited);

        std::vector<uint32_t> expected;
        for (uint32_t i = 0; i < container.triangles().size(); ++i) {
            const Box box = boxOf(container, i);
            if (meet(query, box.min.data(), box.max.data())) expected.push_back(i);
        }
        std::printf("%zu triangles near the middle, by %zu of %zu nodes: %s\n", found.size(), visited,
                    container.tree().nodes.size() - 1, found == expected ? "right" : "WRONG");
        return found == expected ? 0 : 1;
    } catch (const bvhio::Error& error) {
        return std::fprintf(stderr, "own_traversal: %s\n", error.what()), int(error.status());
    }
}
