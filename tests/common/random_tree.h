// Binary trees of random shapes, for tests of what divides trees.
#pragma once

#include <vector>

#include "core/random.h"

namespace bvhio::test {

/// Makes item `i` a child of one before it, of any that has room: items have two `children`, kNone where
/// there is none. Returns its parent.
template <class Item>
uint32_t attachAtRandom(std::vector<Item>& items, uint32_t i, Random& random) {
    uint32_t parent, side;
    do {
        parent = random.below(i);
        side = random.below(2);
    } while (items[parent].children[side] != Item::kNone);
    items[parent].children[side] = i;
    return parent;
}

}  // namespace bvhio::test
