// Where a traversal of the mvh form is. Not per target: what the compiler itself adds to a class, such as the
// copying of what has a cursor in it, would not be for the target.
#pragma once

#include "core/intersect.h"

namespace bvhio {

/// A node's box as a ray meets its planes, and the ray's interval in it: a tree starts from any box and
/// interval at no cost.
struct MvhPart {
    using Four = float __attribute__((vector_size(16)));

    Four near;  // by axis; lane 3: where the ray enters
    Four far;   // lane 3: minus where it leaves

    BVHIO_INLINE float enter() const { return near[3]; }
};

class MvhCursor {
  public:
    MvhCursor() = default;
    BVHIO_INLINE MvhCursor(const MvhPart& whole, uint32_t number, uint32_t turn)
        : part(whole), node_(uint64_t(turn) << 32 | number) {}
    // As they were written: what was just written in other pieces can't be read for a while.
    BVHIO_INLINE MvhCursor(const MvhCursor& other) : part(other.part), node_(other.node_) {}
    BVHIO_INLINE MvhCursor& operator=(const MvhCursor& other) {
        part = other.part;
        node_ = other.node_;
        return *this;
    }

    BVHIO_INLINE uint32_t node() const { return uint32_t(node_); }
    BVHIO_INLINE uint32_t turn() const { return uint32_t(node_ >> 32); }
    MvhPart part;

  private:
    uint64_t node_;  // the upper half is whose turn it is
};

}  // namespace bvhio
