// Dynamic programming over all subsets: there are 15 for four primitives, and 25 ways to split them.

#include "build/small_tree.h"

#include <bit>
#include <cstring>

namespace bvhio {
namespace {

struct SmallTree {
    const Reference* references;
    const LeafRule& rule;
    Node* nodes;
    uint32_t& next;
    uint32_t* primitives;
    uint32_t position;

    Box bounds[1 << kSmallTree];
    float costs[1 << kSmallTree];
    uint32_t lefts[1 << kSmallTree];  // the subset that goes left; 0 = a leaf

    void solve(uint32_t count) {
        for (uint32_t set = 1; set < 1u << count; ++set) {
            const uint32_t lowest = set & (0 - set), rest = set ^ lowest;
            if (rest == 0) {
                std::memcpy(&bounds[set], references + std::countr_zero(set), sizeof(Box));
            } else {
                bounds[set] = bounds[rest];
                bounds[set].extend(bounds[lowest]);
            }
            const float area = bounds[set].halfArea();
            lefts[set] = 0;
            if (rest == 0) {
                costs[set] = rule.cost(area, 1);
                continue;
            }
            // The left side is the one that holds the lowest primitive.
            float best = std::numeric_limits<float>::infinity();
            for (uint32_t others = (rest - 1) & rest;; others = (others - 1) & rest) {
                const uint32_t left = others | lowest;
                const float cost = costs[left] + costs[set ^ left];
                if (cost < best || lefts[set] == 0) {
                    best = cost;
                    lefts[set] = left;
                }
                if (others == 0) break;
            }
            costs[set] = best + rule.traversal * area;
            const auto size = uint32_t(std::popcount(set));
            if (size <= rule.maxLeafSize && rule.cost(area, size) <= costs[set]) {
                costs[set] = rule.cost(area, size);
                lefts[set] = 0;
            }
        }
    }

    void write(uint32_t set, Node& node) {
        if (lefts[set] == 0) {
            const auto size = uint32_t(std::popcount(set));
            node = {bounds[set].toAabb(), position, size};
            for (uint32_t rest = set; rest != 0; rest &= rest - 1)
                primitives[position++] = references[std::countr_zero(rest)].primitive;
            return;
        }
        const uint32_t pair = next;
        next += 2;
        node = {bounds[set].toAabb(), pair, 0};
        write(lefts[set], nodes[pair]);
        write(set ^ lefts[set], nodes[pair + 1]);
    }
};

}  // namespace

float buildSmallTree(const Reference* references, uint32_t count, uint32_t begin, const LeafRule& rule,
                     Node& node, Node* nodes, uint32_t& next, uint32_t* primitives) {
    SmallTree tree{references, rule, nodes, next, primitives, begin, {}, {}, {}};
    tree.solve(count);
    const uint32_t all = (1u << count) - 1;
    tree.write(all, node);
    return tree.costs[all];
}

}  // namespace bvhio
