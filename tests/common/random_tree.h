// Binary trees of random shapes, for tests of code that divides trees.
#pragma once

#include <vector>

#include "core/random.h"

namespace bvhio::test {

/// Makes item `i` a child of a random item before it that has room. Items have two `children`, which are
/// kNone if missing. Returns the parent.
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
