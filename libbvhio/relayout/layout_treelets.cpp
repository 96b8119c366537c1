// D. Wodniok, A. Schulz, S. Widmer, M. Goesele, "Analysis of Cache Behavior and Performance of Different BVH
// Memory Layouts for Tracing Incoherent Rays", EGPGV 2013. A treelet grows from its root to those children
// that are likely enough to be entered if their parent is. All other children become roots of treelets.
//
// Departures: the size of treelets may be limited. Of two children in a treelet the likelier one comes first.
// Treelets wait on a stack, not in a queue. A treelet's likeliest child treelet is on top, so that it follows
// its parent: with a queue the same thresholds give up to 1.5 times the misses of plain depth-first order.

#include "relayout/layout_treelets.h"

#include <algorithm>
#include <deque>

namespace bvhio {
namespace {

/// Grows a treelet, and appends the children that are not in it to `others`.
void grow(const PairTree& tree, const TreeletRule& rule, uint32_t root, std::vector<uint32_t>& order,
          std::vector<uint32_t>& others) {
    const bool depthFirst = rule.growth == TreeletGrowth::depthFirst;
    std::deque<uint32_t> open{root};
    for (uint32_t count = 0; !open.empty() && count < rule.maxPairs; ++count) {
        const uint32_t pair = open.front();
        open.pop_front();
        order.push_back(pair);
        std::array<uint32_t, 2> children;
        const uint32_t found = tree.children(pair, true, children);
        if (depthFirst)
            std::reverse(children.begin(), children.begin() + found);  // the one pushed last is next
        for (uint32_t i = 0; i < found; ++i) {
            if (!(tree[children[i]].weight > rule.threshold * tree[pair].weight))
                others.push_back(children[i]);
            else if (depthFirst)
                open.push_front(children[i]);
            else
                open.push_back(children[i]);
        }
    }
    others.insert(others.end(), open.begin(), open.end());
}

}  // namespace

std::vector<uint32_t> orderTreelets(const PairTree& tree, const TreeletRule& rule) {
    std::vector<uint32_t> order, roots, others;
    order.reserve(tree.size());
    if (tree.size() > 0) roots.push_back(0);
    while (!roots.empty()) {
        const uint32_t root = roots.back();
        roots.pop_back();
        others.clear();
        grow(tree, rule, root, order, others);
        std::sort(others.begin(), others.end(), [&](uint32_t a, uint32_t b) {
            return tree[a].weight != tree[b].weight ? tree[a].weight < tree[b].weight : a > b;
        });
        roots.insert(roots.end(), others.begin(), others.end());
    }
    return order;
}

}  // namespace bvhio
