#include "core/available_threads.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <filesystem>
#include <fstream>

namespace bvhio {
namespace {

namespace fs = std::filesystem;

/// A directory with the files of /proc and /sys that a system of control groups would show.
class Cgroups : public testing::Test {
  protected:
    void SetUp() override { fs::create_directory(root_); }
    void TearDown() override { fs::remove_all(root_); }

    void write(const std::string& name, const std::string& text) const {
        const fs::path path = root_ / name;
        fs::create_directories(path.parent_path());
        std::ofstream(path) << text;
    }
    size_t threads() const { return cgroupThreads(root_.string()); }

    const fs::path root_ = fs::temp_directory_path() / ("bvhio_cgroups_" + std::to_string(getpid()));
};

TEST_F(Cgroups, withoutQuotaGiveNone) {
    EXPECT_EQ(threads(), 0u);
    write("proc/self/cgroup", "0::/job\n");
    EXPECT_EQ(threads(), 0u);
    write("sys/fs/cgroup/job/cpu.max", "max 100000\n");
    EXPECT_EQ(threads(), 0u);
}

// Fails if a slot of two processors on a machine of 64 starts 64 threads.
TEST_F(Cgroups, ofVersion2LimitThreads) {
    write("proc/self/cgroup", "0::/jobs/7\n");
    write("sys/fs/cgroup/jobs/7/cpu.max", "200000 100000\n");
    EXPECT_EQ(threads(), 2u);
    write("sys/fs/cgroup/jobs/7/cpu.max", "150000 100000\n");
    EXPECT_EQ(threads(), 2u);
    write("sys/fs/cgroup/jobs/7/cpu.max", "1000 100000\n");
    EXPECT_EQ(threads(), 1u);
}

// Fails if the quota of a group above is overlooked: it binds those below.
TEST_F(Cgroups, areBoundByThoseAbove) {
    write("proc/self/cgroup", "0::/jobs/7\n");
    write("sys/fs/cgroup/jobs/7/cpu.max", "800000 100000\n");
    write("sys/fs/cgroup/jobs/cpu.max", "300000 100000\n");
    EXPECT_EQ(threads(), 3u);
}

TEST_F(Cgroups, ofVersion1LimitThreads) {
    write("proc/self/cgroup", "5:memory:/jobs\n4:cpu,cpuacct:/jobs\n1:name=systemd:/jobs\n");
    write("sys/fs/cgroup/cpu/jobs/cpu.cfs_quota_us", "-1\n");
    write("sys/fs/cgroup/cpu/jobs/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(threads(), 0u);
    write("sys/fs/cgroup/cpu/jobs/cpu.cfs_quota_us", "400000\n");
    EXPECT_EQ(threads(), 4u);
}

// Fails if a container, which sees its own group at the mount and the host's path in /proc, gets no limit.
TEST_F(Cgroups, ofContainersAreAtTheMount) {
    write("proc/self/cgroup", "4:cpu,cpuacct:/docker/0123\n");
    write("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "300000\n");
    write("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(threads(), 3u);
}

TEST(AvailableThreads, areNoMoreThanTheAffinityAllows) {
    cpu_set_t set;
    ASSERT_EQ(sched_getaffinity(0, sizeof set, &set), 0);
    EXPECT_GE(availableThreads(), 1u);
    EXPECT_LE(availableThreads(), size_t(CPU_COUNT(&set)));
}

}  // namespace
}  // namespace bvhio
