#include "restructure/reinsertion_treelet.h"

#include <algorithm>

namespace bvhio {
namespace {

constexpr uint32_t kMostTaken = 4;  // subtrees that a step takes out

}  // namespace

ReinsertionTreelet::ReinsertionTreelet(const SubtreeMoves& moves, uint32_t root, uint32_t maxLeaves)
    : rootBox_(moves.tree()[root].bounds) {
    parts_.reserve(2 * maxLeaves);
    std::vector<std::pair<double, uint32_t>> open;  // a heap: the largest area first; of equals, the first
    const auto consider = [&](uint32_t part) {
        if (moves.becomesLeaf(parts_[part].slot)) return;
        open.push_back({parts_[part].area, ~part});
        std::push_heap(open.begin(), open.end());
    };
    consider(add(moves.tree()[root], root));
    for (; leaves_ < maxLeaves && !open.empty(); ++leaves_) {
        std::pop_heap(open.begin(), open.end());
        const uint32_t part = ~open.back().second;
        open.pop_back();
        const uint32_t pair = moves.tree()[parts_[part].slot].left();
        pairs_.push_back(pair);
        areas_ += parts_[part].area;
        for (uint32_t side = 0; side < 2; ++side) {
            const uint32_t child = add(moves.tree()[pair + side], pair + side);
            parts_[child].parent = part;
            parts_[part].children[side] = child;
            consider(child);
        }
    }
}

uint32_t ReinsertionTreelet::add(const Node& node, uint32_t slot) {
    parts_.push_back({node.bounds, slot, halfArea(node.bounds)});
    return uint32_t(parts_.size() - 1);
}

std::vector<uint32_t> ReinsertionTreelet::openLeaves(const SubtreeMoves& moves) const {
    std::vector<uint32_t> slots;
    for (const Part& part : parts_)
        if (part.isLeaf() && !moves.becomesLeaf(part.slot)) slots.push_back(part.slot);
    return slots;
}

uint32_t ReinsertionTreelet::improve(uint32_t steps, Random& random) {
    uint32_t better = 0;
    for (uint32_t i = 0; i < steps; ++i) better += step(random);
    return better;
}

/// Picks a node at random. Large nodes matter more, so they are more likely.
uint32_t ReinsertionTreelet::pick(Random& random) const {
    uint32_t best = random.below(uint32_t(parts_.size()));
    for (int i = 0; i < 3; ++i) {
        const uint32_t other = random.below(uint32_t(parts_.size()));
        if (parts_[other].area > parts_[best].area) best = other;
    }
    return best;
}

/// Picks more nodes below an ancestor a few levels up, so that no node is below another one.
void ReinsertionTreelet::pickMore(uint32_t first, Random& random) {
    uint32_t ancestor = first;
    for (uint32_t up = random.below(4); up > 0 && parts_[ancestor].parent != kNone; --up)
        ancestor = parts_[ancestor].parent;
    taken_.assign(1, first);
    for (uint32_t i = 1; i < kMostTaken; ++i) {
        uint32_t part = ancestor;
        for (uint32_t down = 1 + random.below(5); down > 0 && !parts_[part].isLeaf(); --down)
            part = parts_[part].children[random.below(2)];
        if (std::none_of(taken_.begin(), taken_.end(),
                         [&](uint32_t other) { return isBelow(part, other) || isBelow(other, part); }))
            taken_.push_back(part);
    }
}

/// Takes out some subtrees and puts them back. Returns whether that lowered the sum; if not, all is as
/// before.
bool ReinsertionTreelet::step(Random& random) {
    // Pick the subtrees, in random order.
    const uint32_t first = pick(random);
    if (parts_[first].parent == kNone) return false;
    pickMore(first, random);
    for (size_t i = taken_.size(); i > 1; --i) std::swap(taken_[i - 1], taken_[random.below(uint32_t(i))]);

    // Take them out.
    const double before = areas_;
    double waiting = 0;  // the areas of those that are out
    siblings_.clear();
    for (size_t i = 0; i < taken_.size(); ++i) {
        if (parts_[taken_[i]].parent == kNone) {
            // All others were taken out: this one stays.
            taken_.resize(i);
            break;
        }
        siblings_.push_back(takeOut(taken_[i]));
        waiting += parts_[taken_[i]].area;
    }

    // Put them back at the best places. If the sum is not lower then, undo everything.
    const double wanted = before - 1e-9 * parts_[root_].area;
    size_t placed = 0;
    for (; placed < taken_.size(); ++placed) {
        waiting -= parts_[taken_[placed]].area;
        const uint32_t place = bestPlace(taken_[placed], wanted - areas_ - waiting);
        if (place == kNone) break;
        putBeside(taken_[placed], place);
    }
    if (placed == taken_.size() && areas_ < wanted) return true;
    while (placed > 0) takeOut(taken_[--placed]);
    for (size_t i = taken_.size(); i > 0; --i) putBeside(taken_[i - 1], siblings_[i - 1]);
    areas_ = before;
    return false;
}

bool ReinsertionTreelet::isBelow(uint32_t part, uint32_t top) const {
    while (part != top && part != kNone) part = parts_[part].parent;
    return part == top;
}

uint32_t ReinsertionTreelet::sibling(uint32_t part) const {
    const Part& parent = parts_[parts_[part].parent];
    return parent.children[parent.children[0] == part ? 1 : 0];
}

/// Takes out a subtree. Its sibling takes the parent's place. Returns the sibling.
uint32_t ReinsertionTreelet::takeOut(uint32_t part) {
    const uint32_t parent = parts_[part].parent, other = sibling(part), above = parts_[parent].parent;
    areas_ -= parts_[parent].area;
    free_.push_back(parent);
    parts_[other].parent = above;
    if (above == kNone) {
        root_ = other;
    } else {
        parts_[above].children[parts_[above].children[0] == parent ? 0 : 1] = other;
        refit(above);
    }
    return other;
}

void ReinsertionTreelet::putBeside(uint32_t part, uint32_t beside) {
    const uint32_t parent = free_.back(), above = parts_[beside].parent;
    free_.pop_back();
    Part& made = parts_[parent];
    made.parent = above;
    made.children[0] = beside;
    made.children[1] = part;
    made.box = unite(parts_[beside].box, parts_[part].box);
    made.area = halfArea(made.box);
    areas_ += made.area;
    parts_[beside].parent = parts_[part].parent = parent;
    if (above == kNone) {
        root_ = parent;
    } else {
        parts_[above].children[parts_[above].children[0] == beside ? 0 : 1] = parent;
        refit(above);
    }
}

void ReinsertionTreelet::refit(uint32_t part) {
    for (; part != kNone; part = parts_[part].parent) {
        Part& node = parts_[part];
        const Aabb box = unite(parts_[node.children[0]].box, parts_[node.children[1]].box);
        if (box == node.box) return;
        node.box = box;
        areas_ -= node.area;
        node.area = halfArea(box);
        areas_ += node.area;
    }
}

/// Returns the node next to which a part costs least; kNone if that cost is not less than `limit`.
uint32_t ReinsertionTreelet::bestPlace(uint32_t part, double limit) {
    const Aabb box = parts_[part].box;
    const double area = parts_[part].area;
    uint32_t best = kNone;
    open_.assign(1, {0, root_});
    while (!open_.empty()) {
        const Visit visit = open_.back();
        open_.pop_back();
        if (!(visit.grown + area < limit)) continue;
        const Part& node = parts_[visit.part];
        const double cost = visit.grown + halfArea(unite(node.box, box));
        if (cost < limit) {
            limit = cost;
            best = visit.part;
        }
        const double grown = cost - node.area;
        if (node.isLeaf() || !(grown + area < limit)) continue;
        // Visit the child that grows less first.
        const auto growth = [&](uint32_t child) {
            return halfArea(unite(parts_[child].box, box)) - parts_[child].area;
        };
        const bool swap = growth(node.children[0]) < growth(node.children[1]);
        open_.push_back({grown, node.children[swap ? 1 : 0]});
        open_.push_back({grown, node.children[swap ? 0 : 1]});
    }
    return best;
}

void ReinsertionTreelet::write(SubtreeMoves& moves) {
    if (leaves_ == 1) return;
    std::vector<SubtreeMoves::Content> contents(parts_.size());
    for (size_t i = 0; i < parts_.size(); ++i)
        if (parts_[i].isLeaf()) contents[i] = moves.content(parts_[i].slot);
    // Assign the treelet's pairs in depth-first order. The root keeps its pair.
    std::sort(pairs_.begin() + 1, pairs_.end());
    parts_[root_].slot = parts_[0].slot;
    std::vector<uint32_t> stack{root_}, made;
    while (!stack.empty()) {
        Part& part = parts_[stack.back()];
        const uint32_t index = stack.back();
        stack.pop_back();
        if (part.isLeaf()) {
            moves.put(part.slot, contents[index]);
            continue;
        }
        for (uint32_t side = 0; side < 2; ++side)
            parts_[part.children[side]].slot = pairs_[made.size()] + side;
        made.push_back(index);
        stack.push_back(part.children[1]);
        stack.push_back(part.children[0]);
    }
    for (size_t i = made.size(); i-- > 0;)
        moves.make(parts_[made[i]].slot, pairs_[i], i == 0 ? rootBox_ : parts_[made[i]].box);
}

}  // namespace bvhio
