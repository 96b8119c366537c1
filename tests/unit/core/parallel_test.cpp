#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "core/available_threads.h"

namespace bvhio {
namespace {

using Chunks = std::set<std::pair<size_t, size_t>>;

Chunks chunksOf(size_t count, size_t grain) {
    Chunks seen;
    std::mutex mutex;
    parallelChunks(count, grain, [&](size_t begin, size_t end) {
        const std::lock_guard lock(mutex);
        EXPECT_TRUE(seen.emplace(begin, end).second);
    });
    return seen;
}

// Fails if the borders of chunks depend on the threads: what is merged in chunk order would, too.
TEST(Parallel, chunksAreTheSameForAnyNumberOfThreads) {
    const Chunks expected = {{0, 4}, {4, 8}, {8, 10}};
    EXPECT_EQ(chunksOf(10, 4), expected);
    const ThreadLimit one(1);
    EXPECT_EQ(chunksOf(10, 4), expected);
    EXPECT_EQ(chunksOf(4, 4), (Chunks{{0, 4}}));
    EXPECT_EQ(chunksOf(0, 4), Chunks{});
}

// Fails if a failure in one task is lost, or ends the process because it came from another thread.
TEST(Parallel, failuresOfTasksReachTheCaller) {
    const auto fail = [](size_t begin, size_t) {
        if (begin == 512) throw std::runtime_error("chunk 512");
    };
    const auto check = [&] {
        EXPECT_THROW(parallelChunks(1000, 1, fail), std::runtime_error);
        TaskGroup group;
        group.run([] {});
        group.run([] { throw std::runtime_error("a task"); });
        EXPECT_THROW(group.wait(), std::runtime_error);
        EXPECT_NO_THROW(group.wait());
    };
    check();
    const ThreadLimit one(1);
    check();
}

// Fails if tasks outlive what they refer to, when the thread that started them leaves by an exception.
TEST(Parallel, groupsEndBeforeTheirScope) {
    for (int repeat = 0; repeat < 200; ++repeat) {
        std::atomic<int> running = 0;
        try {
            TaskGroup group;
            for (int i = 0; i < 8; ++i)
                group.run([&] {
                    ++running;
                    std::this_thread::yield();
                    --running;
                });
            throw std::runtime_error("left");
        } catch (const std::runtime_error&) {
        }
        ASSERT_EQ(running, 0);
    }
}

// Fails if an inner limit raises an outer one, outlives its scope, or is not that of the tasks under it.
TEST(Parallel, limitsNest) {
    const size_t all = threadCount();
    EXPECT_LE(all, availableThreads());
    {
        const ThreadLimit one(1);
        EXPECT_EQ(threadCount(), 1u);
        const ThreadLimit many(100000), same(0);
        EXPECT_EQ(threadCount(), 1u);
    }
    const ThreadLimit two(2);
    const size_t expected = std::min<size_t>(all, 2);
    EXPECT_EQ(threadCount(), expected);
    parallelChunks(100, 1, [&](size_t, size_t) { EXPECT_EQ(threadCount(), expected); });
}

// Fails if one thread's limit binds another's work, as it would with one limit for the process.
TEST(Parallel, limitsBelongToTheirThread) {
    const size_t all = threadCount();
    const ThreadLimit one(1);
    std::thread([&] { EXPECT_EQ(threadCount(), all); }).join();
}

// Fails if work under a limit of one thread runs elsewhere than on the caller.
TEST(Parallel, oneThreadIsTheCallers) {
    const ThreadLimit one(1);
    const auto caller = std::this_thread::get_id();
    const auto check = [&](auto...) { EXPECT_EQ(std::this_thread::get_id(), caller); };
    parallelChunks(100, 1, check);
    TaskGroup group;
    group.run(check);
    group.wait();
    parallelInOrder<int>(100, check, check, check);
}

// Fails if an item is finished with another's workspace, or placed out of turn.
TEST(Parallel, itemsArePlacedInOrder) {
    const auto check = [] {
        size_t placed = 0;
        std::atomic<size_t> finished = 0;
        parallelInOrder<size_t>(
            1000, [](size_t i, size_t& workspace) { workspace = i; },
            [&](size_t i) { EXPECT_EQ(i, placed++); },
            [&](size_t i, size_t& workspace) { finished += workspace == i; });
        EXPECT_EQ(placed, 1000u);
        EXPECT_EQ(finished, 1000u);
    };
    check();
    const ThreadLimit one(1);
    check();
}

}  // namespace
}  // namespace bvhio
