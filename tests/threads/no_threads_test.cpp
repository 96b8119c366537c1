// What happens where the system starts no thread at all (a limit of processes or of memory). A program of its
// own, since it takes the place of pthread_create for everything in it.
#include <gtest/gtest.h>
#include <pthread.h>

#include <cerrno>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "core/parallel.h"

extern "C" int pthread_create(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*) noexcept {
    return EAGAIN;
}

namespace bvhio {
namespace {

// Fails if parallel code ends the process, or throws, because no thread can be had: the caller's is enough.
TEST(NoThreads, workIsDoneByTheCaller) {
    EXPECT_EQ(threadCount(), 1u);
    const ThreadLimit limit(8);
    EXPECT_EQ(threadCount(), 1u);
    std::vector<int> seen(1000);
    parallelChunks(seen.size(), 1, [&](size_t begin, size_t) { ++seen[begin]; });
    EXPECT_EQ(std::accumulate(seen.begin(), seen.end(), 0), 1000);
    TaskGroup group;
    int ran = 0;
    group.run([&] { ++ran; });
    group.run([] { throw std::runtime_error("a task"); });
    EXPECT_THROW(group.wait(), std::runtime_error);
    EXPECT_EQ(ran, 1);
}

}  // namespace
}  // namespace bvhio
