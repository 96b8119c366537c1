// What restructurers share: a tree that can be changed in place, opened to one reference a leaf, and the way
// back to a canonical tree that costs no more than the given one.
#pragma once

#include <chrono>

#include "core/buffer.h"
#include "restructure/restructurers.h"

namespace bvhio {

/// A tree of sibling pairs, with links up where they are asked for. Methods move nodes between slots, which
/// keeps their number, and need not keep children behind their parents; at first they are.
class TreeEditor {
  public:
    enum class Links { up, none };  // none: nodes have no parents to ask for or to set

    /// With options.collapse every leaf of several references is opened down to single ones, a part of a
    /// split triangle keeping the box that it has in that leaf; else leaves stay whole. Parallel.
    TreeEditor(const Scene& scene, const Bvh& bvh, const RestructureOptions& options,
               Links links = Links::up);

    size_t size() const { return nodes_.size(); }
    /// 0 is the root, 1 unused; a pair is 2 k and 2 k + 1.
    Node& operator[](uint32_t index) { return nodes_[index]; }
    const Node& operator[](uint32_t index) const { return nodes_[index]; }
    Node* data() { return nodes_.data(); }
    /// The node whose children a pair is; 0 for the root's own slot too.
    uint32_t parent(uint32_t index) const { return parentOfPair_[index / 2]; }
    void setParent(uint32_t index, uint32_t parent) { parentOfPair_[index / 2] = parent; }
    /// Tells a node's children where it stands now.
    void adopt(uint32_t index) {
        if (!nodes_[index].isLeaf()) setParent(nodes_[index].left(), index);
    }
    uint32_t sibling(uint32_t index) const { return index ^ 1; }

    const RestructureOptions& options() const { return options_; }
    /// Most primitives of a leaf that forms.
    uint32_t maxLeafSize() const { return maxLeafSize_; }
    /// The bytes of the tree itself.
    size_t bytes() const;

    /// Notes an iteration's time and, when asked for, the cost reached.
    void endIteration(uint64_t changes);
    /// The canonical tree: collapsed, or as it is; the given one unless that costs less. `workBytes` is
    /// what the method needed beside the editor.
    Restructured finish(size_t workBytes) &&;

  private:
    using Clock = std::chrono::steady_clock;
    void open(const Scene& scene);

    const Bvh& given_;
    const RestructureOptions options_;
    uint32_t maxLeafSize_;
    Buffer<Node> nodes_;
    Buffer<uint32_t> parentOfPair_;
    SharedArray<uint32_t> primitives_;
    std::vector<RestructureIteration> iterations_;
    double recordingSeconds_ = 0;
    Clock::time_point iterationStart_ = Clock::now();
};

/// A power of two that brings the root's extent near 1, so that areas in float neither overflow nor vanish.
float extentScale(const Aabb& root);

}  // namespace bvhio
