// Threads: loops in chunks, work that forks and joins, and a limit on the threads that both use. parallel.cpp
// implements it with oneTBB, reader/parallel.cpp without threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "core/function_ref.h"

namespace bvhio {

struct ThreadCrew;

/// Calls body(begin, end) over disjoint chunks that cover [0, count), each of at most `grain` items. The
/// chunk borders depend on count and grain alone, never on the number of threads, so results merged in chunk
/// order are the same for any thread count. Throws what a body throws, after all running bodies have ended.
void parallelChunks(size_t count, size_t grain, FunctionRef<void(size_t, size_t)> body);

/// Work that forks and joins. One thread makes it, calls run and waits.
class TaskGroup {
  public:
    TaskGroup();
    /// When an exception kept wait() from being called: leaves out what has not begun, and waits for the
    /// rest.
    ~TaskGroup();
    TaskGroup(const TaskGroup&) = delete;
    TaskGroup& operator=(const TaskGroup&) = delete;

    /// Starts task(), on any thread, or runs it at once. What it refers to must live until wait() returns.
    template <class Task>
    void run(Task task) {
        start(std::make_unique<Holder<Task>>(std::move(task)));
    }

    /// Joins all tasks that were run, and throws what the first failed one threw.
    void wait();

  private:
    struct Work {
        virtual ~Work() = default;
        virtual void operator()() = 0;
    };
    template <class Task>
    struct Holder final : Work {
        explicit Holder(Task&& held) : task(std::move(held)) {}
        void operator()() override { task(); }
        Task task;
    };
    struct Started;

    void start(std::unique_ptr<Work> work);

    std::unique_ptr<Started> started_;  // null until the first run
};

/// The number of threads that parallel code uses here, at least 1.
size_t threadCount();

/// Limits the threads that parallel code uses while this object lives, in the thread that made it: to
/// `threads`, but never more than an enclosing limit or availableThreads() allows. 0 only keeps those.
class ThreadLimit {
  public:
    explicit ThreadLimit(size_t threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

  private:
    std::unique_ptr<ThreadCrew> crew_;
    [[maybe_unused]] ThreadCrew* enclosing_;  // the reader, which has no threads, does not use it
};

namespace detail {

/// parallelInOrder with the workspaces by number: `limit` of them.
void runInOrder(size_t count, size_t limit, FunctionRef<void(size_t, size_t)> make,
                FunctionRef<void(size_t)> place, FunctionRef<void(size_t, size_t)> finish);

}  // namespace detail

/// Calls make(i, workspace) for i from 0 to count - 1 on all threads, about in order; place(i) after it, one
/// at a time and in order; then finish(i, workspace), on all threads again. Few are under way at a time, each
/// with a Workspace that others had before: so what make leaves there for finish can stay in the caches,
/// though its place depends on all before it.
template <class Workspace, class Make, class Place, class Finish>
void parallelInOrder(size_t count, const Make& make, const Place& place, const Finish& finish) {
    std::vector<Workspace> workspaces(std::min(count, 4 * threadCount()));
    detail::runInOrder(
        count, workspaces.size(), [&](size_t i, size_t workspace) { make(i, workspaces[workspace]); }, place,
        [&](size_t i, size_t workspace) { finish(i, workspaces[workspace]); });
}

}  // namespace bvhio
