// What a report says of the machine that it was made on.
#pragma once

#include <cstdint>
#include <string>

namespace bvhio {

/// The processor's model as the system names it: "AMD EPYC 7763 64-Core Processor"; "unknown" where the
/// system does not name it.
std::string processorName();

/// The most memory that the process has had, in bytes.
uint64_t peakBytes();

}  // namespace bvhio
