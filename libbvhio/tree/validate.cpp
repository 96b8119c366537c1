// Validation takes three sweeps. The first looks at each node on its own, in any order, and marks what the
// node refers to: the pair of its children, the start of its range of primitives, and each primitive. The
// second checks the marks: if there are as many inner nodes as pairs, and each pair has a mark, then by the
// pigeonhole principle each pair has one parent. The third follows the parents to find the depth.

#include "tree/validate.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <map>
#include <mutex>
#include <numeric>

#include "core/parallel.h"

namespace bvhio {
namespace {

constexpr size_t kGrain = 16384;

/// The findings of one chunk of work, at most `maxPerId` of each kind.
class Findings {
  public:
    explicit Findings(size_t maxPerId) : maxPerId_(maxPerId) {}
    void add(FindingId id, uint64_t node, const std::string& message) {
        if (counts_[id]++ < maxPerId_)
            list_.push_back({id, Finding::Severity::error, message, "", kNowhere, node});
    }
    void merge(const Findings& other) {
        for (const Finding& finding : other.list_) add(finding.id, finding.node, finding.message);
    }
    bool empty() const { return list_.empty(); }
    /// Returns whether an index is wrong, and not only a box.
    bool structural() const {
        return std::any_of(list_.begin(), list_.end(),
                           [](const Finding& f) { return f.id < FindingId::boxNotFinite; });
    }
    std::vector<Finding> sorted() {
        std::stable_sort(list_.begin(), list_.end(),
                         [](const Finding& a, const Finding& b) { return a.id < b.id; });
        return std::move(list_);
    }

  private:
    size_t maxPerId_;
    std::map<FindingId, size_t> counts_;
    std::vector<Finding> list_;
};

/// Calls body(begin, end, findings) over [0, count) in parallel, and gathers the findings in order. Returns
/// the sum of the counts that body returns.
template <class Body>
uint64_t sweep(size_t count, Findings& findings, size_t maxPerId, const Body& body) {
    std::atomic<uint64_t> sum = 0;
    std::mutex mutex;
    std::map<size_t, Findings> found;
    parallelChunks(count, kGrain, [&](size_t begin, size_t end) {
        Findings local(maxPerId);
        sum.fetch_add(body(begin, end, local), std::memory_order_relaxed);
        if (local.empty()) return;
        const std::lock_guard lock(mutex);
        found.emplace(begin, std::move(local));
    });
    for (const auto& [begin, local] : found) findings.merge(local);
    return sum;
}

/// Marks an entry. Several threads may mark the same entry; any one of the marks may remain.
template <class T>
void mark(T& entry, T value) {
    std::atomic_ref<T>(entry).store(value, std::memory_order_relaxed);
}

std::string number(uint64_t n) {
    return std::to_string(n);
}

/// Leaves whose boxes are waiting to be compared with the boxes of their primitives.
struct LeafBatch {
    std::vector<uint32_t> leaves, primitives;
    std::vector<Aabb> boxes;

    void add(size_t leaf, std::span<const uint32_t> range) {
        leaves.push_back(uint32_t(leaf));
        primitives.insert(primitives.end(), range.begin(), range.end());
    }
    bool full() const { return primitives.size() >= 1024; }
};

struct Validator {
    Validator(const Bvh& bvh, uint32_t count, const PrimitiveBounds& boundsOf, size_t max)
        : nodes(bvh.nodes),
          primitives(bvh.primitives),
          primitiveCount(count),
          primitiveBounds(boundsOf),
          maxPerId(max) {}

    std::span<const Node> nodes;
    std::span<const uint32_t> primitives;
    uint32_t primitiveCount;
    const PrimitiveBounds& primitiveBounds;
    size_t maxPerId;

    Findings findings{maxPerId};
    std::vector<uint32_t> parentOfPair;  // index of the parent + 1; 0 if there is no parent
    std::vector<uint16_t> leafAt;        // size of the leaf that starts at an entry of `primitives`, or 0
    std::vector<uint8_t> inLeaf;         // 1 for a primitive that some leaf refers to
    uint32_t treeDepth = 0;

    bool split() const { return primitives.size() > primitiveCount; }

    void checkInner(size_t i, Findings& found) {
        const uint32_t left = nodes[i].first;
        if (left % 2 != 0 || left <= i || left >= nodes.size()) {
            found.add(FindingId::childIndex, i,
                      "node " + number(i) + " has its children at index " + number(left) +
                          ", which is not even, above " + number(i) + " and below " + number(nodes.size()));
            return;
        }
        mark(parentOfPair[left / 2], uint32_t(i + 1));
        for (const uint32_t child : {left, left + 1})
            if (!nodes[i].bounds.contains(nodes[child].bounds))
                found.add(FindingId::childOutsideParent, child,
                          "the box of node " + number(child) + " extends outside the box of its parent " +
                              number(i));
    }

    void checkLeaf(size_t i, LeafBatch& batch, Findings& found) {
        const Node& leaf = nodes[i];
        if (leaf.primitiveCount > kMaxLeafSize ||
            uint64_t(leaf.first) + leaf.primitiveCount > primitives.size()) {
            found.add(FindingId::leafRange, i,
                      "leaf " + number(i) + " has " + number(leaf.primitiveCount) +
                          " primitives from entry " + number(leaf.first) + " on: at most " +
                          number(kMaxLeafSize) + " are allowed, within the " + number(primitives.size()) +
                          " entries");
            return;
        }
        mark(leafAt[leaf.first], uint16_t(leaf.primitiveCount));
        const auto range = primitives.subspan(leaf.first, leaf.primitiveCount);
        for (const uint32_t primitive : range) {
            if (primitive >= primitiveCount) {
                found.add(FindingId::primitiveIndex, i,
                          "leaf " + number(i) + " refers to triangle " + number(primitive) +
                              ", but there are only " + number(primitiveCount));
                return;
            }
            mark(inLeaf[primitive], uint8_t(1));
        }
        if (primitiveBounds && !split()) batch.add(i, range);
    }

    /// Compares the boxes of the batch's leaves with the boxes of their primitives, and empties the batch.
    void checkBoxes(LeafBatch& batch, Findings& found) {
        if (batch.leaves.empty()) return;
        batch.boxes.resize(batch.primitives.size());
        primitiveBounds(batch.primitives, batch.boxes.data());
        const Aabb* box = batch.boxes.data();
        for (const uint32_t leaf : batch.leaves) {
            bool inside = true;
            for (const Aabb* end = box + nodes[leaf].primitiveCount; box != end; ++box)
                inside &= nodes[leaf].bounds.contains(*box);
            if (!inside)
                found.add(FindingId::primitiveOutsideLeaf, leaf,
                          "a triangle extends outside the box of leaf " + number(leaf));
        }
        batch.leaves.clear();
        batch.primitives.clear();
    }

    /// Returns the number of inner nodes in the upper half of the result and the number of leaves in the
    /// lower.
    uint64_t checkNodes(size_t begin, size_t end, Findings& found) {
        // Nodes are first sorted into inner nodes and leaves, without a branch: the processor would predict
        // it wrong every other time.
        std::array<uint32_t, 1024> innerNodes, leaves;
        uint64_t innerCount = 0, leafCount = 0;
        LeafBatch batch;
        for (size_t from = begin; from < end; from += innerNodes.size()) {
            size_t inner = 0, leaf = 0;
            for (size_t i = from; i < std::min(end, from + innerNodes.size()); ++i) {
                if (i == 1) continue;  // the unused slot beside the root
                const Aabb& box = nodes[i].bounds;
                if (!isFinite(box.min) || !isFinite(box.max) || box.isEmpty())
                    found.add(FindingId::boxNotFinite, i,
                              "the box of node " + number(i) + " is not finite or has min > max");
                innerNodes[inner] = leaves[leaf] = uint32_t(i);
                inner += !nodes[i].isLeaf();
                leaf += nodes[i].isLeaf();
            }
            for (const uint32_t i : std::span(innerNodes).first(inner)) checkInner(i, found);
            for (const uint32_t i : std::span(leaves).first(leaf)) {
                checkLeaf(i, batch, found);
                if (batch.full()) checkBoxes(batch, found);
            }
            innerCount += inner;
            leafCount += leaf;
        }
        checkBoxes(batch, found);
        return innerCount << 32 | leafCount;
    }

    /// Checks that each pair of siblings has one parent.
    void checkPairs(uint64_t innerNodes) {
        const size_t pairs = nodes.size() / 2;
        const uint64_t marked =
            sweep(pairs, findings, maxPerId, [&](size_t begin, size_t end, Findings& found) {
                uint64_t count = 0;
                for (size_t pair = begin; pair < end; ++pair) {
                    if (parentOfPair[pair] != 0)
                        ++count;
                    else if (pair != 0)
                        found.add(FindingId::sharedChildren, 2 * pair,
                                  "node " + number(2 * pair) + " has no parent");
                }
                return count;
            });
        if (marked == innerNodes) return;
        for (size_t i = 0; i < nodes.size(); ++i) {
            const Node& node = nodes[i];
            if (i == 1 || node.isLeaf() || node.first / 2 >= pairs) continue;
            const uint32_t other = parentOfPair[node.first / 2];
            if (other != 0 && other != i + 1)
                findings.add(FindingId::sharedChildren, i,
                             "nodes " + number(i) + " and " + number(other - 1) + " have the same children");
        }
    }

    /// Checks that the leaves' ranges cover the primitives without overlap, and that each triangle is in a
    /// leaf.
    void checkCover(uint64_t leaves) {
        const size_t count = primitives.size();
        const uint64_t starts =
            sweep(count, findings, maxPerId, [&](size_t begin, size_t end, Findings& found) {
                uint64_t seen = 0;
                for (size_t i = begin; i < end; ++i) {
                    if (leafAt[i] == 0) {
                        if (i == 0) found.add(FindingId::leafCover, kNowhere, "no leaf starts at entry 0");
                        continue;
                    }
                    ++seen;
                    // The next leaf must start where this one ends, and not before.
                    size_t next = i + 1;
                    const size_t stop = i + leafAt[i];
                    while (next < stop && leafAt[next] == 0) ++next;
                    if (next != stop || (stop < count && leafAt[stop] == 0))
                        found.add(FindingId::leafCover, kNowhere,
                                  "the leaves' ranges overlap or leave a gap at entry " + number(next));
                }
                return seen;
            });
        if (starts != leaves)
            findings.add(FindingId::leafCover, kNowhere, "two leaves start at the same entry");
        sweep(primitiveCount, findings, maxPerId, [&](size_t begin, size_t end, Findings& found) {
            const auto first = inLeaf.begin() + ptrdiff_t(begin), last = inLeaf.begin() + ptrdiff_t(end);
            if (std::find(first, last, uint8_t(0)) == last) return 0;
            for (auto at = first; at != last; ++at)
                if (*at == 0)
                    found.add(FindingId::missingPrimitive, kNowhere,
                              "triangle " + number(uint64_t(at - inLeaf.begin())) + " is in no leaf");
            return 0;
        });
    }

    /// Finds the depth: each pair is one deeper than its parent's pair, which comes before it.
    void checkDepth() {
        std::vector<uint8_t> depthOfPair(nodes.size() / 2);
        uint8_t deepest = 0;
        for (size_t pair = 1; pair < depthOfPair.size(); ++pair) {
            const uint8_t depth = uint8_t(depthOfPair[(parentOfPair[pair] - 1) / 2] + 1);
            if (depth > kMaxDepth) {
                findings.add(FindingId::depth, 2 * pair,
                             "node " + number(2 * pair) + " is more than " + number(kMaxDepth) +
                                 " edges below the root");
                return;
            }
            depthOfPair[pair] = depth;
            deepest = std::max(deepest, depth);
        }
        treeDepth = deepest;
    }

    /// Checks triangles that may be in several leaves: each of these leaves must touch the triangle's box,
    /// and their hull must contain it.
    void checkSplitPrimitives() {
        std::vector<uint32_t> all(primitiveCount);
        std::iota(all.begin(), all.end(), 0u);
        std::vector<Aabb> boxes(primitiveCount), hulls(primitiveCount, Aabb::empty());
        primitiveBounds(all, boxes.data());
        for (size_t i = 0; i < nodes.size(); ++i) {
            const Aabb& box = nodes[i].bounds;
            if (!nodes[i].isLeaf()) continue;
            for (const uint32_t primitive : primitives.subspan(nodes[i].first, nodes[i].primitiveCount)) {
                const Aabb common{max(boxes[primitive].min, box.min), min(boxes[primitive].max, box.max)};
                if (common.isEmpty())
                    findings.add(
                        FindingId::primitiveOutsideLeaf, i,
                        "triangle " + number(primitive) + " does not touch the box of its leaf " + number(i));
                hulls[primitive].extend(box);
            }
        }
        for (uint32_t primitive = 0; primitive < primitiveCount; ++primitive)
            if (!hulls[primitive].contains(boxes[primitive]))
                findings.add(FindingId::primitiveOutsideLeaf, kNowhere,
                             "triangle " + number(primitive) + " extends outside the boxes of its leaves");
    }

    void run() {
        if (nodes.size() < 2 || nodes.size() % 2 != 0) {
            findings.add(FindingId::treeCounts, kNowhere,
                         "the tree has an odd number of node slots, or none");
            return;
        }
        if (std::bit_cast<std::array<uint32_t, 8>>(nodes[1]) != std::array<uint32_t, 8>{})
            findings.add(FindingId::unusedSlot, 1, "the unused slot 1 beside the root is not zero");
        parentOfPair.resize(nodes.size() / 2);
        leafAt.resize(primitives.size());
        inLeaf.resize(primitiveCount);
        const uint64_t counts =
            sweep(nodes.size(), findings, maxPerId,
                  [&](size_t begin, size_t end, Findings& found) { return checkNodes(begin, end, found); });
        if (findings.structural()) return;  // the marks mean nothing
        checkPairs(counts >> 32);
        checkCover(counts & 0xFFFFFFFF);
        if (findings.structural()) return;
        checkDepth();
        if (primitiveBounds && split()) checkSplitPrimitives();
    }
};

}  // namespace

Validation validate(const Bvh& bvh, uint32_t primitiveCount, const PrimitiveBounds& primitiveBounds,
                    size_t maxPerId) {
    Validator validator(bvh, primitiveCount, primitiveBounds, maxPerId);
    validator.run();
    return {validator.findings.sorted(), validator.treeDepth};
}

}  // namespace bvhio
