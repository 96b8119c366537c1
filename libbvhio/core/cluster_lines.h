// The records of an address cluster in lines.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace bvhio {

/// A record of a cluster, or a glue record, which has no children; children come behind their parents.
struct ClusterItem {
    static constexpr uint32_t kNone = 0xFFFFFFFF;

    uint32_t word;      // what its slot will hold
    double weight = 0;  // how often it is visited
    std::array<uint32_t, 2> children{kNone, kNone};
};

/// Items of one line each, at most `lineSlots`, parents before their children.
using ClusterLines = std::vector<std::vector<uint32_t>>;

/// Lines with the fewest expected steps from one to another, as far as connected parts of a cluster go:
/// then short ones share a line.
ClusterLines packLines(const std::vector<ClusterItem>& items, uint32_t lineSlots);

/// Lines as the paper has them: each grows from its root by the heaviest item at its border; full ones come
/// first, short ones share lines, the longest first.
ClusterLines growLines(const std::vector<ClusterItem>& items, uint32_t lineSlots);

}  // namespace bvhio
