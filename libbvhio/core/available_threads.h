// How many threads can run at a time for this process.
#pragma once

#include <cstddef>
#include <string>

namespace bvhio {

/// The processors that the process may use: those of its CPU affinity (taskset), but no more than the CPU
/// quota of its control group (containers, batch systems) pays for, rounded up. At least 1. Read once.
size_t availableThreads();

/// The processors that control groups pay for, rounded up, or 0 when they set no quota. Reads versions 1 and
/// 2 of cgroups from the files below `root`, which is "" but in tests.
size_t cgroupThreads(const std::string& root);

}  // namespace bvhio
