// The records of an address cluster in lines.
#pragma once

#include <span>
#include <vector>

#include "tree/connected_parts.h"

namespace bvhio {

/// Items of one line each, at most `lineSlots`, parents before their children.
using ClusterLines = std::vector<std::vector<uint32_t>>;

/// Lines with the fewest expected steps from one to another, as far as connected parts of a cluster go; what
/// room these leave is filled with others. With each line but the last filled up by padding they take at
/// most `maxSlots` slots, of which there are no fewer than items.
ClusterLines packLines(std::span<const TreeItem> items, uint32_t lineSlots, uint32_t maxSlots);

/// Lines as the paper has them: each grows from its root by the heaviest item at its border; full ones come
/// first, short ones share lines, the longest first.
ClusterLines growLines(std::span<const TreeItem> items, uint32_t lineSlots);

}  // namespace bvhio
