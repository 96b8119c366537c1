// How much of its work a pass has done, and how a listener ends the pass early.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>

namespace bvhio {

/// Ends a pass that was cancelled. It is not an Error: nothing is wrong with the data.
struct Cancelled : std::exception {
    const char* what() const noexcept override { return "cancelled"; }
};

/// Receives a pass's progress, called from the pass's own threads, several at once. An exception that it
/// throws ends the pass: the pass's function throws it on, and the pass's input stays unchanged.
class ProgressListener {
  public:
    virtual ~ProgressListener() = default;
    virtual void advanced(uint64_t done, uint64_t total) = 0;
};

/// A pass's progress. The pass adds finished work to `done`, from any thread, in portions so large that the
/// addition costs nothing. Another thread may read `done`, or a listener is called after each addition.
/// `total` is in the same unit, and 0 while it is unknown.
struct Progress {
    std::atomic<uint64_t> done{0}, total{0};
    ProgressListener* listener = nullptr;

    void start(uint64_t newTotal) {
        done.store(0, std::memory_order_relaxed);
        total.store(newTotal, std::memory_order_relaxed);
        report(0);
    }
    void add(uint64_t amount) { report(done.fetch_add(amount, std::memory_order_relaxed) + amount); }

  private:
    void report(uint64_t now) {
        if (listener) listener->advanced(now, total.load(std::memory_order_relaxed));
    }
};

}  // namespace bvhio
