// Treelets of disjoint subtrees share nothing. So one task handles each subtree of a few thousand references,
// and the nodes above these subtrees, few enough for one thread, come last. Unlike in the papers no node
// waits for a counter that its children increment, and the result cannot depend on the threads.

#include "restructure/treelets.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "restructure/tree_editor.h"

namespace bvhio {
namespace {

class TreeletPass {
  public:
    TreeletPass(TreeEditor& editor, const TreeletMethod& method, uint32_t size)
        : editor_(editor),
          planner_(method.planner),
          topPasses_(method.topPasses),
          size_(size),
          scale_(extentScale(editor[0].bounds)),
          costs_{editor.options().costs.traversal, editor.options().costs.intersection,
                 editor.options().collapse ? float(editor.maxLeafSize()) : 0.0f},
          states_(editor.size()) {
        measure();
    }

    uint32_t references() const { return states_[0].references; }
    size_t bytes() const { return states_.size() * sizeof(State); }

    /// Runs one pass over the inner nodes with at least `gamma` references. Returns how many treelets
    /// changed.
    uint64_t run(uint32_t gamma) {
        // The subtrees, in parallel.
        std::vector<uint32_t> subtrees;
        std::vector<uint32_t> top = nodesAbove(kSubtree, gamma, &subtrees);
        std::vector<uint64_t> changes(subtrees.size());
        Progress* const progress = editor_.options().progress;
        parallelChunks(subtrees.size(), 1, [&](size_t i, size_t) {
            Workspace work;
            changes[i] = visitAll(nodesBelow(subtrees[i], gamma), work);
            const uint32_t least = std::max(kTop, gamma);
            for (uint32_t k = 1; k < topPasses_ && isCandidate(subtrees[i], least); ++k) {
                const uint64_t more = visitAll(nodesBelow(subtrees[i], least), work);
                changes[i] += more;
                if (more == 0) break;
            }
            if (progress) progress->add(states_[subtrees[i]].references);
        });

        // The nodes above them.
        uint64_t all = 0, done = 0;
        for (size_t i = 0; i < subtrees.size(); ++i) {
            all += changes[i];
            done += states_[subtrees[i]].references;
        }
        Workspace work;
        for (uint32_t k = 0; k < topPasses_; ++k) {
            const uint64_t more = visitAll(top, work);
            all += more;
            if (more == 0) break;
            top = nodesAbove(kSubtree, gamma, nullptr);
        }
        if (progress) progress->add(references() - done);
        return all;
    }

  private:
    static constexpr uint32_t kSubtree = 4096;  // the most references of a task's subtree
    static constexpr uint32_t kTop = 512;       // the fewest references of a node that is visited repeatedly

    /// The data of a node besides its box.
    struct State {
        float cost;  // of the subtree, in scaled areas
        uint32_t references;
    };

    struct Workspace {
        Treelet treelet;
        TreeletPlan plan;
        uint32_t inner[kMaxTreeletSize - 1];  // the root first
        uint32_t leaves[kMaxTreeletSize];
    };

    /// Returns whether a node is the root of a treelet in this pass.
    bool isCandidate(uint32_t index, uint32_t gamma) const {
        return states_[index].references >= gamma && !editor_[index].isLeaf();
    }

    /// Returns the candidates with more than `size` references, parents first. Appends the topmost candidates
    /// with fewer to `others`.
    std::vector<uint32_t> nodesAbove(uint32_t size, uint32_t gamma, std::vector<uint32_t>* others) const {
        std::vector<uint32_t> nodes, open{0};
        while (!open.empty()) {
            const uint32_t index = open.back();
            open.pop_back();
            if (!isCandidate(index, gamma)) continue;
            if (states_[index].references > size) {
                nodes.push_back(index);
                open.insert(open.end(), {editor_[index].left(), editor_[index].right()});
            } else if (others) {
                others->push_back(index);
            }
        }
        return nodes;
    }

    /// Returns all candidates of a candidate's subtree, depth first, so that a node's treelet is still in the
    /// cache when its parent's treelet needs it.
    std::vector<uint32_t> nodesBelow(uint32_t root, uint32_t gamma) const {
        std::vector<uint32_t> nodes, open{root};
        while (!open.empty()) {
            const uint32_t index = open.back();
            open.pop_back();
            nodes.push_back(index);
            for (const uint32_t child : {editor_[index].left(), editor_[index].right()})
                if (isCandidate(child, gamma)) open.push_back(child);
        }
        return nodes;
    }

    float area(const Aabb& box) const {
        const float x = box.max.x * scale_ - box.min.x * scale_, y = box.max.y * scale_ - box.min.y * scale_,
                    z = box.max.z * scale_ - box.min.z * scale_;
        return x * (y + z) + y * z;
    }

    float costOf(uint32_t index) const {
        const Node& node = editor_[index];
        return costs_.of(area(node.bounds), float(states_[index].references), states_[node.left()].cost,
                         states_[node.right()].cost);
    }

    /// Sets all states. The tree has not been changed yet, so children come after their parents.
    void measure() {
        for (auto i = uint32_t(states_.size()); i-- > 0;) {
            if (i == 1) continue;
            const Node& node = editor_[i];
            if (node.isLeaf()) {
                states_[i] = {costs_.intersection * area(node.bounds) * float(node.primitiveCount),
                              node.primitiveCount};
            } else {
                states_[i].references = states_[node.left()].references + states_[node.right()].references;
                states_[i].cost = costOf(i);
            }
        }
    }

    /// Visits nodes from the last to the first.
    uint64_t visitAll(const std::vector<uint32_t>& nodes, Workspace& work) {
        uint64_t changes = 0;
        for (size_t i = nodes.size(); i-- > 0;) changes += visit(nodes[i], work);
        return changes;
    }

    /// Forms the treelet of a root, and rebuilds it if that lowers the cost. Returns whether it did.
    bool visit(uint32_t root, Workspace& work) {
        states_[root].cost = costOf(root);
        form(root, work);
        const uint32_t size = work.treelet.size;
        if (size < 3) return false;
        // A gain must exceed the rounding error of sums of floats.
        const float limit = states_[root].cost * (1 - float(size) * 0x1p-23f);
        if (!planner_(work.treelet, costs_, limit, work.plan)) return false;
        apply(work);
        return true;
    }

    /// Forms the treelet of a root. Of leaves of equal area the first is replaced. Its left child takes its
    /// place, and the right child is appended.
    void form(uint32_t root, Workspace& work) const {
        uint32_t* const leaves = work.leaves;
        // Keys are ordered by area, then by place; 0 for nodes without children. Branches would often be
        // mispredicted.
        uint64_t keys[kMaxTreeletSize];
        const auto put = [&](uint32_t place, uint32_t index) {
            const Node& node = editor_[index];
            // Prefetch data that may be far away and is needed soon.
            hwy::Prefetch(&editor_[node.primitiveCount == 0 ? node.first : index]);
            hwy::Prefetch(&states_[index]);
            const uint64_t key =
                uint64_t(std::bit_cast<uint32_t>(area(node.bounds))) << 32 | (kMaxTreeletSize - place);
            keys[place] = key & (0 - uint64_t(node.primitiveCount == 0));
            leaves[place] = index;
        };
        work.inner[0] = root;
        put(0, editor_[root].left());
        put(1, editor_[root].right());
        uint32_t size = 2;
        for (; size < size_; ++size) {
            uint64_t largest = keys[0];
            for (uint32_t i = 1; i < size; ++i) largest = keys[i] > largest ? keys[i] : largest;
            if (largest == 0) break;
            const uint32_t place = kMaxTreeletSize - uint32_t(largest);
            work.inner[size - 1] = leaves[place];
            const uint32_t left = editor_[leaves[place]].left();
            put(place, left);
            put(size, left + 1);
        }

        // Copy the leaves' data, component by component.
        Treelet& treelet = work.treelet;
        treelet.size = size;
        for (uint32_t i = 0; i < size; ++i) {
            const auto& [min, max] = editor_[leaves[i]].bounds;
            const float sides[6] = {-min.x, -min.y, -min.z, max.x, max.y, max.z};
            for (int side = 0; side < 6; ++side) treelet.boxes[side][i] = sides[side] * scale_;
            treelet.costs[i] = states_[leaves[i]].cost;
            treelet.references[i] = float(states_[leaves[i]].references);
        }
    }

    /// Carries out the plan: nodes of the treelet get new places in the treelet's pairs.
    void apply(const Workspace& work) {
        const uint32_t size = work.treelet.size;
        uint32_t pairs[kMaxTreeletSize - 1];
        for (uint32_t i = 0; i + 1 < size; ++i) pairs[i] = editor_[work.inner[i]].left();
        Node nodes[2 * kMaxTreeletSize - 1];
        State states[2 * kMaxTreeletSize - 1];
        for (uint32_t i = 0; i < size; ++i) {
            nodes[i] = editor_[work.leaves[i]];
            states[i] = states_[work.leaves[i]];
        }
        for (uint32_t step = 0; step + 1 < size; ++step) {
            const uint32_t pair = pairs[size - 2 - step];
            const uint32_t children[2] = {work.plan.left[step], work.plan.right[step]};
            for (uint32_t side = 0; side < 2; ++side) {
                editor_[pair + side] = nodes[children[side]];
                states_[pair + side] = states[children[side]];
            }
            const State &left = states[children[0]], &right = states[children[1]];
            const Aabb bounds = unite(nodes[children[0]].bounds, nodes[children[1]].bounds);
            const uint32_t references = left.references + right.references;
            nodes[size + step] = {bounds, pair, 0};
            states[size + step] = {costs_.of(area(bounds), float(references), left.cost, right.cost),
                                   references};
        }
        // The root keeps its box, which may be larger than the union of its children's boxes.
        const uint32_t root = work.inner[0];
        editor_[root].first = pairs[0];
        states_[root].cost = costOf(root);
    }

    TreeEditor& editor_;
    const TreeletPlanner planner_;
    const uint32_t topPasses_;
    const uint32_t size_;
    const float scale_;
    const TreeletCosts costs_;
    Buffer<State> states_;
};

}  // namespace

Restructured restructureTreelets(const Scene& scene, const Bvh& bvh, const RestructureOptions& options,
                                 const TreeletMethod& method) {
    const uint32_t size = options.treeletSize == 0 ? method.size : options.treeletSize;
    if (size < 3 || size > method.largestSize)
        throw Error(ErrorKind::usage, "treelet size " + std::to_string(size) + " is out of range: use 3 to " +
                                          std::to_string(method.largestSize));
    TreeEditor editor(scene, bvh, options, TreeEditor::Links::none);
    TreeletPass pass(editor, method, size);
    std::vector<uint32_t> gammas;
    const uint32_t iterations = options.iterations == 0 ? method.iterations : options.iterations;
    for (uint64_t gamma = options.gamma == 0 ? size : options.gamma;
         gamma <= pass.references() && gammas.size() < iterations; gamma *= 2)
        gammas.push_back(std::max(uint32_t(gamma), 3u));  // with fewer references there is nothing to change
    if (options.progress) options.progress->start(uint64_t(pass.references()) * gammas.size());
    for (const uint32_t gamma : gammas) editor.endIteration(pass.run(gamma));
    return std::move(editor).finish(pass.bytes());
}

}  // namespace bvhio
