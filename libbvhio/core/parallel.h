// Threads, through oneTBB: the only header that knows it.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

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

/// Calls make(i, workspace) for i from 0 to count - 1 on all threads, about in order; place(i) after it, one
/// at a time and in order; then finish(i, workspace), on all threads again. Few are under way at a time, each
/// with a Workspace that others had before: so what make leaves there for finish can stay in the caches,
/// though its place depends on all before it.
template <class Workspace, class Make, class Place, class Finish>
void parallelInOrder(size_t count, const Make& make, const Place& place, const Finish& finish) {
    struct Job {
        size_t index;
        Workspace* workspace;
    };
    const size_t limit = std::min(count, 4 * threadCount());
    std::vector<Workspace> workspaces(limit);
    std::vector<Workspace*> idle;
    for (Workspace& workspace : workspaces) idle.push_back(&workspace);
    std::mutex mutex;  // of `idle`
    size_t next = 0;
    const auto start = [&](tbb::flow_control& control) -> Job {
        if (next == count) {
            control.stop();
            return {};
        }
        const std::lock_guard lock(mutex);
        Workspace* const workspace = idle.back();
        idle.pop_back();
        return {next++, workspace};
    };
    const auto makeOne = [&](const Job& job) {
        make(job.index, *job.workspace);
        return job;
    };
    const auto placeOne = [&](const Job& job) {
        place(job.index);
        return job;
    };
    const auto finishOne = [&](const Job& job) {
        finish(job.index, *job.workspace);
        const std::lock_guard lock(mutex);
        idle.push_back(job.workspace);
    };
    using tbb::filter_mode;
    tbb::parallel_pipeline(limit, tbb::make_filter<void, Job>(filter_mode::serial_in_order, start) &
                                      tbb::make_filter<Job, Job>(filter_mode::parallel, makeOne) &
                                      tbb::make_filter<Job, Job>(filter_mode::serial_in_order, placeOne) &
                                      tbb::make_filter<Job, void>(filter_mode::parallel, finishOne));
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
