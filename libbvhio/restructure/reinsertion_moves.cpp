#include "restructure/reinsertion_moves.h"

namespace bvhio {

SubtreeMoves::SubtreeMoves(TreeEditor& tree, uint8_t* touched)
    : tree_(tree),
      touched_(touched),
      traversal_(tree.options().costs.traversal),
      intersection_(tree.options().costs.intersection),
      maxLeafSize_(tree.options().collapse ? tree.maxLeafSize() : 0),
      small_(tree.size()) {
    for (auto i = uint32_t(tree.size()); i-- > 0;) {
        if (i == 1) continue;
        const Node& node = tree[i];
        small_[i] =
            node.isLeaf() ? leaf(node) : inner(node.bounds, small_[node.left()], small_[node.right()]);
    }
}

SubtreeMoves::Small SubtreeMoves::leaf(const Node& node) const {
    return {intersection_ * halfArea(node.bounds) * node.primitiveCount, sumOf(node.primitiveCount, 0)};
}

SubtreeMoves::Small SubtreeMoves::inner(const Aabb& box, const Small& left, const Small& right) const {
    const uint32_t count = sumOf(left.count, right.count);
    if (!fewEnough(count)) return {0, count};
    const double area = halfArea(box);
    return {std::min(traversal_ * area + left.cost + right.cost, intersection_ * area * count), count};
}

bool SubtreeMoves::becomesLeaf(uint32_t slot) const {
    const Node& node = tree_[slot];
    const Small& small = small_[slot];
    return node.isLeaf() ||
           (fewEnough(small.count) && small.cost == intersection_ * halfArea(node.bounds) * small.count);
}

void SubtreeMoves::put(uint32_t slot, const Content& content) {
    tree_[slot] = content.node;
    small_[slot] = content.small;
    tree_.adopt(slot);
}

void SubtreeMoves::make(uint32_t slot, uint32_t pair, const Aabb& box) {
    tree_[slot] = {box, pair, 0};
    small_[slot] = inner(box, small_[pair], small_[pair + 1]);
    tree_.adopt(slot);
    touched_[pair] = touched_[pair + 1] = 1;
}

bool SubtreeMoves::climb(uint32_t from, Path& path) const {
    path.count = 0;
    while (path.count < path.slots.size()) {
        path.slots[path.count++] = from;
        if (from == 0) return true;
        from = tree_.parent(from);
    }
    return false;
}

bool SubtreeMoves::move(uint32_t moved, uint32_t beside) {
    // A change this small may be rounding.
    const double least = 1e-7 * traversal_ * halfArea(tree_[tree_.parent(moved)].bounds);
    if (!(change(moved, beside) < -least)) return false;
    apply(moved, beside);
    return true;
}

/// Returns the change of the cost, not divided by the root's area; 0 for a move that is not possible.
double SubtreeMoves::change(uint32_t moved, uint32_t beside) {
    if (beside == tree_.sibling(moved)) return 0;
    // Find the lowest node above both. Nodes too deep for a path, which a reasonable tree does not have,
    // stay.
    if (!climb(moved, movedPath_) || !climb(beside, besidePath_)) return 0;
    uint32_t onMoved = movedPath_.count, onBeside = besidePath_.count;
    while (onMoved > 0 && onBeside > 0 && movedPath_.slots[onMoved - 1] == besidePath_.slots[onBeside - 1])
        --onMoved, --onBeside;
    // Neither may be above the other.
    if (onMoved == 0 || onBeside == 0) return 0;

    // Compute the changes on both sides, up to the children of the lowest node above both.
    Changed with = withMoved(moved, beside);
    for (uint32_t i = 1; i < onBeside; ++i) {
        const uint32_t slot = besidePath_.slots[i];
        with = above(besidePath_.slots[i - 1], with, unite(tree_[slot].bounds, tree_[moved].bounds));
    }
    uint32_t slot = movedPath_.slots[onMoved];
    Changed both;
    if (onMoved == 1) {
        // The moved node went into the subtree of its sibling, which takes the parent's place.
        both = with;
        both.delta += withoutMoved(moved).delta;
    } else {
        Changed without = withoutMoved(moved);
        for (uint32_t i = 2; i < onMoved; ++i) {
            const uint32_t child = movedPath_.slots[i - 1];
            without = above(child, without, unite(without.box, tree_[tree_.sibling(child)].bounds));
        }
        both = {tree_[slot].bounds, with.delta + without.delta,
                inner(tree_[slot].bounds, with.small, without.small)};
        if (fewEnough(both.small.count)) both.delta = both.small.cost - small_[slot].cost;
    }
    // Further up only costs change. From the lowest node that stays an inner node on, all change by the same
    // amount.
    for (; slot != 0 && fewEnough(small_[slot].count); slot = tree_.parent(slot))
        both = above(slot, both, tree_[tree_.parent(slot)].bounds);
    return both.delta;
}

/// Returns the parent's slot after the sibling has moved there.
SubtreeMoves::Changed SubtreeMoves::withoutMoved(uint32_t moved) const {
    const uint32_t sibling = tree_.sibling(moved), parent = tree_.parent(moved);
    const double delta = fewEnough(small_[parent].count)
                             ? small_[sibling].cost - small_[parent].cost
                             : -traversal_ * halfArea(tree_[parent].bounds) - small_[moved].cost;
    return {tree_[sibling].bounds, delta, small_[sibling]};
}

/// Returns the new parent.
SubtreeMoves::Changed SubtreeMoves::withMoved(uint32_t moved, uint32_t beside) const {
    const Aabb box = unite(tree_[moved].bounds, tree_[beside].bounds);
    const Small small = inner(box, small_[moved], small_[beside]);
    const double delta = fewEnough(small.count) ? small.cost - small_[beside].cost
                                                : traversal_ * halfArea(box) + small_[moved].cost;
    return {box, delta, small};
}

/// Returns the parent of a child that changed.
SubtreeMoves::Changed SubtreeMoves::above(uint32_t child, const Changed& below, const Aabb& box) const {
    const uint32_t slot = tree_.parent(child), sibling = tree_.sibling(child);
    const Small small = inner(box, below.small, small_[sibling]);
    const bool wasFew = fewEnough(small_[slot].count), isFew = fewEnough(small.count);
    const double was = traversal_ * halfArea(tree_[slot].bounds), is = traversal_ * halfArea(box);
    double delta = below.delta + is - was;
    if (isFew && wasFew)
        delta = small.cost - small_[slot].cost;
    else if (isFew)
        delta = small.cost - (was + below.small.cost - below.delta + small_[sibling].cost);
    else if (wasFew)
        delta = is + small_[child].cost + below.delta + small_[sibling].cost - small_[slot].cost;
    return {box, delta, small};
}

/// Makes a move: the sibling takes the parent's place, and the free pair gets `beside`, whose slot becomes
/// the new parent.
void SubtreeMoves::apply(uint32_t moved, uint32_t beside) {
    const uint32_t sibling = tree_.sibling(moved), parent = tree_.parent(moved);
    const Aabb rootBox = tree_[0].bounds;
    put(parent, content(sibling));
    put(sibling, content(beside));
    tree_[beside].first = sibling & ~1u;
    tree_[beside].primitiveCount = 0;
    tree_.adopt(beside);
    if (parent == 0) tree_[0].bounds = rootBox;
    touch(parent);
    touch(sibling);
    touch(beside);
    update(beside);
    if (parent != 0) update(tree_.parent(parent));
}

void SubtreeMoves::update(uint32_t from) {
    for (;; from = tree_.parent(from)) {
        const Node& left = tree_[tree_[from].left()];
        const Node& right = tree_[tree_[from].right()];
        const Aabb box = from == 0 ? tree_[0].bounds : unite(left.bounds, right.bounds);
        const Small small = inner(box, small_[tree_[from].left()], small_[tree_[from].right()]);
        const bool sameBox = box == tree_[from].bounds;
        if (sameBox && small.cost == small_[from].cost && small.count == small_[from].count) return;
        tree_[from].bounds = box;
        small_[from] = small;
        if (!sameBox) touch(from);
        if (from == 0) return;
    }
}

/// Flags a node whose box or place changed, its sibling and its children: they may find better places now.
void SubtreeMoves::touch(uint32_t slot) {
    touched_[slot] = touched_[tree_.sibling(slot)] = 1;
    if (!tree_[slot].isLeaf()) touched_[tree_[slot].left()] = touched_[tree_[slot].right()] = 1;
}

}  // namespace bvhio
