// How far a pass has come.
#pragma once

#include <atomic>
#include <cstdint>

namespace bvhio {

/// A pass adds to `done` what it has finished, from any thread and in portions that cost nothing; someone who
/// waits watches it from another thread. `total` is in the same unit, 0 while it is unknown.
struct Progress {
    std::atomic<uint64_t> done{0}, total{0};

    void start(uint64_t newTotal) {
        done.store(0, std::memory_order_relaxed);
        total.store(newTotal, std::memory_order_relaxed);
    }
    void add(uint64_t amount) { done.fetch_add(amount, std::memory_order_relaxed); }
};

}  // namespace bvhio
