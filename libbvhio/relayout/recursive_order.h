// Recursive layouts, which cut a tree into a top and the subtrees below it, and each of these again.
#pragma once

#include <algorithm>
#include <span>

#include "relayout/pair_tree.h"

namespace bvhio {

/// Appends the members of a connected part of the tree, given by ascending numbers, to `order`: first the top
/// that `cut.top(members)` chooses, and then each subtree below it, in the order of `cut.isBefore` for their
/// first pairs. The top and the subtrees are cut in the same way. A top is ascending and connected, and
/// contains the first member, but not all members if there are more than two.
template <class Cut>
void orderRecursively(const PairTree& tree, std::span<const uint32_t> members, const Cut& cut,
                      std::vector<uint32_t>& order) {
    if (members.size() <= 2) {
        order.insert(order.end(), members.begin(), members.end());
        return;
    }
    const std::vector<uint32_t> top = cut.top(members);
    orderRecursively(tree, std::span<const uint32_t>(top), cut, order);

    // The numbers of a subtree are one run, so its members are one run, too.
    struct Subtree {
        uint32_t first;
        std::span<const uint32_t> members;
    };
    std::vector<Subtree> subtrees;
    size_t inTop = 0;
    for (size_t i = 0; i < members.size();) {
        if (inTop < top.size() && top[inTop] == members[i]) {
            ++inTop;
            ++i;
            continue;
        }
        const uint32_t end = members[i] + tree[members[i]].size;
        const auto last = std::lower_bound(members.begin() + std::ptrdiff_t(i), members.end(), end);
        const auto count = size_t(last - members.begin()) - i;
        subtrees.push_back({members[i], members.subspan(i, count)});
        i += count;
    }
    std::stable_sort(subtrees.begin(), subtrees.end(),
                     [&](const Subtree& a, const Subtree& b) { return cut.isBefore(a.first, b.first); });
    for (const Subtree& subtree : subtrees) orderRecursively(tree, subtree.members, cut, order);
}

}  // namespace bvhio
