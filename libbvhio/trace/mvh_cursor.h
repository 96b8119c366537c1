// The cursor of a traversal of the mvh form. It is not compiled per target: functions that the compiler
// itself adds to a class, such as copies of classes with a cursor, would not be compiled for the target.
#pragma once

#include "core/intersect.h"

namespace bvhio {

/// A node's box as near and far planes of a ray, and the ray's interval in the box. So traversal can start
/// from any box and interval at no cost.
struct MvhPart {
    using Four = float __attribute__((vector_size(16)));

    Four near;  // by axis; lane 3: the parameter where the ray enters
    Four far;   // by axis; lane 3: minus the parameter where the ray leaves

    BVHIO_INLINE float enter() const { return near[3]; }
};

class MvhCursor {
  public:
    MvhCursor() = default;
    BVHIO_INLINE MvhCursor(const MvhPart& whole, uint32_t number, uint32_t turn)
        : part(whole), node_(uint64_t(turn) << 32 | number) {}
    // Copies whole vectors, as they were written: a read across several recent writes has to wait for them.
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
    uint64_t node_;  // the node in the lower half, and the turn in the upper half
};

}  // namespace bvhio
