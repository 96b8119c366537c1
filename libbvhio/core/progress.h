// How much of its work a pass has done.
#pragma once

#include <atomic>
#include <cstdint>

namespace bvhio {

/// A pass adds the work it has finished to `done`, from any thread, in portions so large that adding costs
/// nothing. Another thread may watch it. `total` is in the same unit, and 0 while it is unknown.
struct Progress {
    std::atomic<uint64_t> done{0}, total{0};

    void start(uint64_t newTotal) {
        done.store(0, std::memory_order_relaxed);
        total.store(newTotal, std::memory_order_relaxed);
    }
    void add(uint64_t amount) { done.fetch_add(amount, std::memory_order_relaxed); }
};

}  // namespace bvhio
