// The metrics policy without costs, which is also the base of all others. Traversal reports its work to a
// policy.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compress/form_concept.h"

namespace bvhio {

/// The arithmetic of one box test: subtractions and multiplications; and comparisons, with minima and
/// maxima.
struct BoxTestCost {
    uint32_t arithmetic, comparisons;
};

/// The test of a box with six planes in coordinates (clipToBox): 6 differences and 6 products; 6 minima and
/// maxima, 4 to merge the axes, 2 comparisons.
inline constexpr BoxTestCost kFullBoxTestCost{12, 12};

/// Does nothing, so each call vanishes. A policy derives from it and defines the functions that it needs.
struct NoMetrics {
    /// A record was read: its byte offset among the form's nodes, and its size in bytes.
    BVHIO_INLINE void recordFetched(size_t, size_t) {}
    /// Boxes were tested: how many, and the cost of each.
    BVHIO_INLINE void boxesTested(uint32_t, BoxTestCost) {}
    BVHIO_INLINE void leafEntered(PrimitiveRange) {}
    /// An entry of a number of bytes was pushed. Each entry is popped once, unless an any-hit query ends.
    BVHIO_INLINE void pushed(size_t) {}
    BVHIO_INLINE void popped(size_t) {}
};

}  // namespace bvhio
