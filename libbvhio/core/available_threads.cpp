#include "core/available_threads.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <thread>
#include <vector>

namespace bvhio {
namespace {

/// The processors of the calling thread's affinity mask, whatever its length.
size_t affinityThreads() {
    for (int processors = 1024; processors <= 1 << 20; processors *= 2) {
        cpu_set_t* const set = CPU_ALLOC(size_t(processors));
        if (!set) break;
        const size_t bytes = CPU_ALLOC_SIZE(size_t(processors));
        const bool got = sched_getaffinity(0, bytes, set) == 0;
        const int count = got ? CPU_COUNT_S(bytes, set) : 0;
        CPU_FREE(set);
        if (got && count > 0) return size_t(count);
    }
    return std::max(1u, std::thread::hardware_concurrency());
}

/// The quota that one control group sets: version 2 has "QUOTA PERIOD" in one file, version 1 two files of
/// one number each. 0: none ("max", -1, or no such file).
double quotaOf(const std::string& group, bool version2) {
    double quota = 0, period = 0;
    if (version2) {
        std::ifstream(group + "/cpu.max") >> quota >> period;
    } else {
        std::ifstream(group + "/cpu.cfs_quota_us") >> quota;
        std::ifstream(group + "/cpu.cfs_period_us") >> period;
    }
    return quota > 0 && period > 0 ? quota / period : 0;
}

/// The least quota of a group and those above it, which bind it too. In a container the path may be the
/// host's, of which only the end of the walk, the mount itself, is there to read.
double leastQuota(const std::string& mount, std::string path, bool version2) {
    double least = 0;
    while (true) {
        const double quota = quotaOf(mount + path, version2);
        if (quota > 0 && (least == 0 || quota < least)) least = quota;
        if (path.empty()) return least;
        path.resize(std::min(path.rfind('/'), path.size() - 1));
    }
}

/// Whether a list of names, with commas between them, has this one.
bool contains(const std::string& list, const std::string& name) {
    std::istringstream names(list);
    for (std::string item; std::getline(names, item, ',');)
        if (item == name) return true;
    return false;
}

}  // namespace

size_t cgroupThreads(const std::string& root) {
    std::ifstream groups(root + "/proc/self/cgroup");  // lines of HIERARCHY:CONTROLLERS:PATH
    double least = 0;
    for (std::string line; std::getline(groups, line);) {
        const size_t first = line.find(':'), second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const bool version2 = controllers.empty();
        if (!version2 && !contains(controllers, "cpu")) continue;
        const std::string mount = root + "/sys/fs/cgroup" + (version2 ? "" : "/cpu");
        const double quota = leastQuota(mount, line.substr(second + 1), version2);
        if (quota > 0 && (least == 0 || quota < least)) least = quota;
    }
    return size_t(std::ceil(least));
}

size_t availableThreads() {
    static const size_t threads = [] {
        const size_t processors = affinityThreads(), paid = cgroupThreads("");
        return paid > 0 ? std::min(processors, paid) : processors;
    }();
    return threads;
}

}  // namespace bvhio
