// Divides the records of an address cluster into lines.
#pragma once

#include <span>
#include <vector>

#include "tree/connected_parts.h"

namespace bvhio {

/// The items of each line: at most `lineSlots` of them, and parents before their children.
using ClusterLines = std::vector<std::vector<uint32_t>>;

/// Divides a cluster into connected parts, each in a line, with the fewest expected steps from one part to
/// another. Room that a part leaves in its line is filled with other parts. The lines take at most `maxSlots`
/// slots when all but the last are padded. `maxSlots` must be at least the number of items.
ClusterLines packLines(std::span<const TreeItem> items, uint32_t lineSlots, uint32_t maxSlots);

/// Makes lines as in the paper: each grows from its root by the heaviest item at its border. Full lines come
/// first; short ones, the longest first, share lines.
ClusterLines growLines(std::span<const TreeItem> items, uint32_t lineSlots);

}  // namespace bvhio
