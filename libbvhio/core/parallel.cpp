// The only file that knows oneTBB.
#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <mutex>
#include <optional>
#include <system_error>
#include <thread>

#include "core/available_threads.h"
#include "core/serial.h"

namespace bvhio {
namespace {

/// How many of the available threads the system lets the process start at a time, the calling one counted.
/// oneTBB cannot go on when it gets fewer than it asked for, so they are tried here first, once.
size_t startableThreads() {
    static const size_t threads = [] {
        std::mutex gate;
        std::vector<std::thread> started;
        {
            const std::lock_guard closed(gate);
            try {
                while (started.size() + 1 < availableThreads())
                    started.emplace_back([&gate] { const std::lock_guard passed(gate); });
            } catch (const std::system_error&) {
                // Fewer it is.
            }
        }
        for (std::thread& thread : started) thread.join();
        return started.size() + 1;
    }();
    return threads;
}

thread_local ThreadCrew* currentCrew = nullptr;

}  // namespace

/// The threads that work for one thread outside and those inside.
struct ThreadCrew {
    explicit ThreadCrew(size_t limit) : threads(limit > 1 ? std::min(limit, startableThreads()) : 1) {
        if (threads > 1) arena.emplace(int(threads));
    }

    /// Runs task() where what it starts is shared among the crew. Only with more than one thread.
    template <class Task>
    void execute(const Task& task) {
        arena->execute(task);
    }

    const size_t threads;
    std::optional<tbb::task_arena> arena;
};

namespace {

/// The crew of the calling thread: its innermost ThreadLimit's, or that of the task that it runs, or its own.
ThreadCrew& crewHere() {
    if (currentCrew) return *currentCrew;
    static thread_local ThreadCrew own(availableThreads());
    return own;
}

/// Lets a thread belong to a crew for as long as it runs one of its tasks.
class Membership {
  public:
    explicit Membership(ThreadCrew& crew) : before_(std::exchange(currentCrew, &crew)) {}
    ~Membership() { currentCrew = before_; }
    Membership(const Membership&) = delete;
    Membership& operator=(const Membership&) = delete;

  private:
    ThreadCrew* const before_;
};

}  // namespace

void parallelChunks(size_t count, size_t grain, FunctionRef<void(size_t, size_t)> body) {
    ThreadCrew& crew = crewHere();
    if (count <= grain || crew.threads == 1) return serial::chunks(count, grain, body);
    const size_t chunks = (count + grain - 1) / grain;
    crew.execute([&] {
        tbb::parallel_for(tbb::blocked_range<size_t>(0, chunks, 1),
                          [&](const tbb::blocked_range<size_t>& range) {
                              const Membership member(crew);
                              for (size_t i = range.begin(); i != range.end(); ++i)
                                  body(i * grain, i * grain + std::min(grain, count - i * grain));
                          });
    });
}

struct TaskGroup::Started {
    ThreadCrew& crew = crewHere();
    serial::Tasks alone;    // with one thread
    tbb::task_group tasks;  // with more
};

TaskGroup::TaskGroup() = default;

TaskGroup::~TaskGroup() {
    if (!started_ || started_->crew.threads == 1) return;
    try {
        started_->crew.execute([&] {
            started_->tasks.cancel();
            started_->tasks.wait();
        });
    } catch (...) {
        // Another exception is on its way: it is the one that counts.
    }
}

void TaskGroup::start(std::unique_ptr<Work> work) {
    if (!started_) started_ = std::make_unique<Started>();
    ThreadCrew& crew = started_->crew;
    if (crew.threads == 1) return started_->alone.run(*work);
    crew.execute([&] {
        started_->tasks.run([&crew, held = std::move(work)] {
            const Membership member(crew);
            (*held)();
        });
    });
}

void TaskGroup::wait() {
    if (!started_) return;
    if (started_->crew.threads == 1) return started_->alone.wait();
    started_->crew.execute([&] { started_->tasks.wait(); });
}

size_t threadCount() {
    return crewHere().threads;
}

ThreadLimit::ThreadLimit(size_t threads) : enclosing_(currentCrew) {
    const size_t allowed = enclosing_ ? enclosing_->threads : availableThreads();
    crew_ = std::make_unique<ThreadCrew>(threads > 0 ? std::min(threads, allowed) : allowed);
    currentCrew = crew_.get();
}

ThreadLimit::~ThreadLimit() {
    currentCrew = enclosing_;
}

void detail::runInOrder(size_t count, size_t limit, FunctionRef<void(size_t, size_t)> make,
                        FunctionRef<void(size_t)> place, FunctionRef<void(size_t, size_t)> finish) {
    ThreadCrew& crew = crewHere();
    if (count <= 1 || crew.threads == 1) return serial::inOrder(count, make, place, finish);
    struct Job {
        size_t index, workspace;
    };
    std::vector<size_t> idle(limit);  // workspaces
    for (size_t i = 0; i < limit; ++i) idle[i] = i;
    std::mutex mutex;  // of `idle`
    size_t next = 0;
    const auto start = [&](tbb::flow_control& control) -> Job {
        if (next == count) {
            control.stop();
            return {};
        }
        const std::lock_guard lock(mutex);
        const size_t workspace = idle.back();
        idle.pop_back();
        return {next++, workspace};
    };
    const auto makeOne = [&](const Job& job) {
        const Membership member(crew);
        make(job.index, job.workspace);
        return job;
    };
    const auto placeOne = [&](const Job& job) {
        const Membership member(crew);
        place(job.index);
        return job;
    };
    const auto finishOne = [&](const Job& job) {
        const Membership member(crew);
        finish(job.index, job.workspace);
        const std::lock_guard lock(mutex);
        idle.push_back(job.workspace);
    };
    using tbb::filter_mode;
    crew.execute([&] {
        tbb::parallel_pipeline(limit, tbb::make_filter<void, Job>(filter_mode::serial_in_order, start) &
                                          tbb::make_filter<Job, Job>(filter_mode::parallel, makeOne) &
                                          tbb::make_filter<Job, Job>(filter_mode::serial_in_order, placeOne) &
                                          tbb::make_filter<Job, void>(filter_mode::parallel, finishOne));
    });
}

}  // namespace bvhio
