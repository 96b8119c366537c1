// core/parallel.h without threads: the reader runs everything on the thread that calls it, and so needs no
// oneTBB.
#include "core/parallel.h"

#include "core/serial.h"

namespace bvhio {

struct ThreadCrew {};

void parallelChunks(size_t count, size_t grain, FunctionRef<void(size_t, size_t)> body) {
    serial::chunks(count, grain, body);
}

struct TaskGroup::Started {
    serial::Tasks tasks;
};

TaskGroup::TaskGroup() = default;
TaskGroup::~TaskGroup() = default;

void TaskGroup::start(std::unique_ptr<Work> work) {
    if (!started_) started_ = std::make_unique<Started>();
    started_->tasks.run(*work);
}

void TaskGroup::wait() {
    if (started_) started_->tasks.wait();
}

size_t threadCount() {
    return 1;
}

ThreadLimit::ThreadLimit(size_t) : enclosing_(nullptr) {}
ThreadLimit::~ThreadLimit() = default;

void detail::runInOrder(size_t count, size_t, FunctionRef<void(size_t, size_t)> make,
                        FunctionRef<void(size_t)> place, FunctionRef<void(size_t, size_t)> finish) {
    serial::inOrder(count, make, place, finish);
}

}  // namespace bvhio
