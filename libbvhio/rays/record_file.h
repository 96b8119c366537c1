// The common format of ray and hit files: a signature of eight characters, a uint64 count, and `count`
// records of plain data.
#pragma once

#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/error.h"

namespace bvhio {

static_assert(std::endian::native == std::endian::little,
              "files are little-endian, and records are copied as they are");

template <class Record>
std::vector<std::byte> encodeRecords(const char (&signature)[9], std::span<const Record> records) {
    static_assert(std::is_trivially_copyable_v<Record>);
    const uint64_t count = records.size();
    std::vector<std::byte> bytes(16 + records.size_bytes());
    std::memcpy(bytes.data(), signature, 8);
    std::memcpy(bytes.data() + 8, &count, 8);
    if (count > 0) std::memcpy(bytes.data() + 16, records.data(), records.size_bytes());
    return bytes;
}

/// Reads a whole file. Throws Error{invalid} if it is not a header followed by exactly as many records as the
/// header says. `what` names the records ("rays").
template <class Record>
std::vector<Record> decodeRecords(const char (&signature)[9], std::span<const std::byte> bytes,
                                  const std::string& what, const std::string& name) {
    static_assert(std::is_trivially_copyable_v<Record>);
    const auto refuse = [&](const std::string& why) { throw Error(ErrorKind::invalid, name + ": " + why); };
    if (bytes.size() < 8 || std::memcmp(bytes.data(), signature, 8) != 0)
        refuse("does not start with '" + std::string(signature) + "': it is not a file of " + what);
    if (bytes.size() < 16) refuse("ends in its header, at byte " + std::to_string(bytes.size()) + " of 16");
    uint64_t count = 0;
    std::memcpy(&count, bytes.data() + 8, 8);
    const uint64_t held = (bytes.size() - 16) / sizeof(Record);
    if (count > held)
        refuse("announces " + std::to_string(count) + " " + what + " but holds " + std::to_string(held) +
               ": it was cut short");
    if (const uint64_t excess = bytes.size() - 16 - count * sizeof(Record); excess > 0)
        refuse(std::to_string(excess) + " bytes follow its " + std::to_string(count) + " " + what);
    std::vector<Record> records(count);
    if (count > 0) std::memcpy(records.data(), bytes.data() + 16, count * sizeof(Record));
    return records;
}

}  // namespace bvhio
