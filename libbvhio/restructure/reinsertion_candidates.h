// Selects the subtrees for which better places are searched.
#pragma once

#include <vector>

#include "core/buffer.h"
#include "restructure/tree_editor.h"

namespace bvhio {

/// A flag for each slot says whether its subtree is worth a search. After a search without a result the flag
/// is cleared, until something about the subtree changes. The most promising of the flagged subtrees come
/// first.
class Candidates {
  public:
    Candidates(const TreeEditor& tree, float scale);

    uint8_t* flags() { return flags_.data(); }
    void flagAll();
    /// Returns the `wanted` most promising flagged slots, or all if there are fewer, in the order of slots.
    /// Parallel.
    const std::vector<uint32_t>& select(size_t wanted);

    size_t bytes() const;

  private:
    static constexpr size_t kGrain = 1 << 15, kBins = 1 << 12;

    void rate(size_t begin, size_t end, uint32_t* bins);

    const TreeEditor& tree_;
    const float scale_;
    Buffer<uint8_t> flags_;
    Buffer<float> promises_;  // -1 if the flag is not set
    std::vector<uint32_t> bins_, selected_;
};

}  // namespace bvhio
