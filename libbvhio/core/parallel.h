// Threads, through oneTBB: the only header that knows it.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_group.h>

#include <cstddef>
#include <memory>

namespace bvhio {

/// Work that forks and joins: run(f) starts f, wait() joins them all.
using TaskGroup = tbb::task_group;

/// Calls body(begin, end) over disjoint chunks that cover [0, count), each of at most `grain` items. The
/// chunk borders depend on count and grain alone, never on the number of threads, so results merged in chunk
/// order are the same for any thread count.
template <class Body>
void parallelChunks(size_t count, size_t grain, const Body& body) {
    if (count == 0) return;
    const size_t chunks = (count + grain - 1) / grain;
    if (chunks == 1) return body(size_t(0), count);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, chunks, 1), [&](const tbb::blocked_range<size_t>& range) {
        for (size_t i = range.begin(); i != range.end(); ++i) {
            const size_t begin = i * grain;
            body(begin, begin + grain < count ? begin + grain : count);
        }
    });
}

/// The number of threads that parallel code uses now.
inline size_t threadCount() {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

/// Calls make(i) for i from 0 to count - 1 on all threads, about in order; place(i) after it, one at a time
/// and in order; then finish(i), on all threads again. Few are under way at a time, so what make(i) prepares
/// for finish(i) can stay in the caches, though its place depends on all before it.
template <class Make, class Place, class Finish>
void parallelInOrder(size_t count, const Make& make, const Place& place, const Finish& finish) {
    size_t next = 0;
    const auto start = [&](tbb::flow_control& control) {
        if (next == count) control.stop();
        return next++;
    };
    const auto makeOne = [&](size_t i) { return make(i), i; };
    const auto placeOne = [&](size_t i) { return place(i), i; };
    const auto finishOne = [&](size_t i) { finish(i); };
    using tbb::filter_mode;
    tbb::parallel_pipeline(4 * threadCount(),
                           tbb::make_filter<void, size_t>(filter_mode::serial_in_order, start) &
                               tbb::make_filter<size_t, size_t>(filter_mode::parallel, makeOne) &
                               tbb::make_filter<size_t, size_t>(filter_mode::serial_in_order, placeOne) &
                               tbb::make_filter<size_t, void>(filter_mode::parallel, finishOne));
}

/// Limits the threads that parallel code uses while it lives; 0 means all of the machine's.
class ThreadLimit {
  public:
    explicit ThreadLimit(size_t threads) {
        if (threads > 0)
            control_ =
                std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
    }

  private:
    std::unique_ptr<tbb::global_control> control_;
};

}  // namespace bvhio
