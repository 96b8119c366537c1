// The common part of restructurers: a tree that can be changed in place, with leaves opened to one reference
// each, and the conversion to a canonical tree that costs no more than the given one.
#pragma once

#include <chrono>

#include "core/buffer.h"
#include "restructure/restructurers.h"

namespace bvhio {

/// A tree of sibling pairs, optionally with links to parents. Methods move nodes between slots, so the number
/// of nodes stays the same. At first children come after their parents, but methods need not keep that.
class TreeEditor {
  public:
    enum class Links { up, none };  // with `none`, parent and setParent must not be called

    /// Copies a tree. With options.collapse every leaf of several references is opened down to leaves of one
    /// reference, where a part of a split triangle keeps the box that it has in the opened leaf. Otherwise
    /// leaves stay whole. Parallel.
    TreeEditor(const Scene& scene, const Bvh& bvh, const RestructureOptions& options,
               Links links = Links::up);

    size_t size() const { return nodes_.size(); }
    /// Returns a node by its slot: 0 is the root, 1 is unused, and 2 k and 2 k + 1 are a pair.
    Node& operator[](uint32_t index) { return nodes_[index]; }
    const Node& operator[](uint32_t index) const { return nodes_[index]; }
    Node* data() { return nodes_.data(); }
    /// Returns the parent of a node; 0 for the root.
    uint32_t parent(uint32_t index) const { return parentOfPair_[index / 2]; }
    void setParent(uint32_t index, uint32_t parent) { parentOfPair_[index / 2] = parent; }
    /// Sets the parent of a node's children to the node's slot.
    void adopt(uint32_t index) {
        if (!nodes_[index].isLeaf()) setParent(nodes_[index].left(), index);
    }
    uint32_t sibling(uint32_t index) const { return index ^ 1; }

    const RestructureOptions& options() const { return options_; }
    /// Returns the most primitives of a leaf that forms.
    uint32_t maxLeafSize() const { return maxLeafSize_; }
    /// Returns the bytes of the tree itself.
    size_t bytes() const;

    /// Records the time of an iteration and, with options.recordCosts, the cost reached.
    void endIteration(uint64_t changes);
    /// Returns the canonical tree, with leaves formed if options.collapse. Returns the given tree if that
    /// costs no more. `workBytes` is the memory that the method used besides the editor's.
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

/// Returns a power of two that brings the root's extent near 1, so that areas in float neither overflow nor
/// vanish.
float extentScale(const Aabb& root);

}  // namespace bvhio
