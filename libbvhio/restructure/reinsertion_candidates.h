// Which subtrees to look for better places for.
#pragma once

#include <vector>

#include "core/buffer.h"
#include "restructure/tree_editor.h"

namespace bvhio {

/// A flag for each slot says whether its subtree is worth a search: once that found nothing, not before
/// something about it changed. Of those, the ones that promise most come first.
class Candidates {
  public:
    Candidates(const TreeEditor& tree, float scale);

    uint8_t* flags() { return flags_.data(); }
    void flagAll();
    /// The most promising `wanted` of the flagged slots, or all, in the order of slots. Parallel.
    const std::vector<uint32_t>& select(size_t wanted);

    size_t bytes() const;

  private:
    static constexpr size_t kGrain = 1 << 15, kBins = 1 << 12;

    void rate(size_t begin, size_t end, uint32_t* bins);

    const TreeEditor& tree_;
    const float scale_;
    Buffer<uint8_t> flags_;
    Buffer<float> promises_;  // -1 where the flag is not set
    std::vector<uint32_t> bins_, selected_;
};

}  // namespace bvhio
