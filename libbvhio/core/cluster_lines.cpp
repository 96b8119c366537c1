#include "core/cluster_lines.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <queue>

namespace bvhio {
namespace {

constexpr uint32_t kNoItem = ClusterItem::kNone;

/// Connected items in one line, parents first.
struct LinePart {
    std::vector<uint32_t> items;
    uint32_t parent = kNoItem;       // the part that has the parent of its first item
    std::vector<uint32_t> children;  // parts
};

/// The best parts by a tree knapsack: with s of its items, a line below an item costs the least that its
/// children's shares of s - 1 do; a child outside the line costs a step there, and its own best line.
class BestParts {
  public:
    BestParts(const std::vector<ClusterItem>& items, uint32_t lineSlots)
        : items_(items),
          stride_(lineSlots + 1),
          cost_(items.size() * stride_),
          share_(cost_.size()),
          sizes_(items.size()) {
        for (size_t i = items.size(); i-- > 0;) findCosts(uint32_t(i), lineSlots);
        parts_.emplace_back();
        for (size_t part = 0; part < parts_.size(); ++part) {
            const uint32_t root = part == 0 ? 0 : roots_[part - 1];
            fill(uint32_t(part), root, bestSize(root));
        }
    }
    std::vector<LinePart> parts() && { return std::move(parts_); }

  private:
    double& cost(uint32_t item, uint32_t size) { return cost_[item * stride_ + size]; }
    /// Of the whole line of an item: the cheapest size, the largest among equal ones.
    uint32_t bestSize(uint32_t item) {
        uint32_t best = 1;
        for (uint32_t size = 2; size <= sizes_[item]; ++size)
            if (cost(item, size) <= cost(item, best)) best = size;
        return best;
    }

    void findCosts(uint32_t item, uint32_t lineSlots) {
        // Column 0 of a child: it starts a line of its own. That is known when the parent is met.
        uint32_t room[2] = {};
        for (size_t side = 0; side < 2; ++side)
            if (const uint32_t child = items_[item].children[side]; child != kNoItem)
                room[side] = sizes_[child];
        sizes_[item] = std::min(lineSlots, 1 + room[0] + room[1]);
        for (uint32_t size = 1; size <= sizes_[item]; ++size) {
            double best = std::numeric_limits<double>::infinity();
            const uint32_t least = size - 1 > room[1] ? size - 1 - room[1] : 0;
            for (uint32_t left = least; left <= std::min(size - 1, room[0]); ++left) {
                const double sum = costOf(item, 0, left) + costOf(item, 1, size - 1 - left);
                if (sum < best) {
                    best = sum;
                    share_[item * stride_ + size] = uint8_t(left);
                }
            }
            cost(item, size) = best;
        }
        cost(item, 0) = items_[item].weight + cost(item, bestSize(item));
    }
    double costOf(uint32_t item, size_t side, uint32_t size) {
        const uint32_t child = items_[item].children[side];
        return child == kNoItem ? 0 : cost(child, size);
    }

    void fill(uint32_t part, uint32_t item, uint32_t size) {
        parts_[part].items.push_back(item);
        const uint32_t left = share_[item * stride_ + size];
        const uint32_t shares[2] = {left, size - 1 - left};
        for (size_t side = 0; side < 2; ++side) {
            const uint32_t child = items_[item].children[side];
            if (child == kNoItem) continue;
            if (shares[side] > 0) {
                fill(part, child, shares[side]);
            } else {
                parts_[part].children.push_back(uint32_t(parts_.size()));
                parts_.emplace_back().parent = part;
                roots_.push_back(child);
            }
        }
    }

    const std::vector<ClusterItem>& items_;
    size_t stride_;
    std::vector<double> cost_;
    std::vector<uint8_t> share_;   // of the left child
    std::vector<uint32_t> sizes_;  // the most items in a line below an item
    std::vector<LinePart> parts_;
    std::vector<uint32_t> roots_;  // first items of parts 1 and on
};

/// Puts parts into lines. A part may be placed once its parent is, so that items stay behind their parents.
/// Parts that others wait for and full ones open lines, the heaviest first; what room they leave is filled
/// from the rest: siblings first, then the longest that fits.
class LinesOfParts {
  public:
    LinesOfParts(const std::vector<ClusterItem>& items, const std::vector<LinePart>& parts,
                 uint32_t lineSlots)
        : items_(items),
          parts_(parts),
          lineSlots_(lineSlots),
          bySize_(lineSlots),
          isPlaced_(parts.size()),
          first_(Lighter{*this}) {
        makeReady(0);
        while (true) {
            uint32_t part = kNoItem;
            while (part == kNoItem && !first_.empty()) {
                if (!isPlaced_[first_.top()]) part = first_.top();
                first_.pop();
            }
            if (part == kNoItem) part = longest(lineSlots - 1);
            if (part == kNoItem) break;
            lines_.emplace_back();
            for (uint32_t next = part; next != kNoItem;) {
                place(next);
                const uint32_t room = lineSlots_ - uint32_t(lines_.back().size());
                next = siblingOf(part, room);
                if (next == kNoItem) next = longest(room);
            }
        }
    }
    ClusterLines lines() && { return std::move(lines_); }

  private:
    struct Lighter {
        const LinesOfParts& lines;
        bool operator()(uint32_t a, uint32_t b) const {
            const double weightOfA = lines.weight(a), weightOfB = lines.weight(b);
            return weightOfA != weightOfB ? weightOfA < weightOfB : a > b;
        }
    };
    double weight(uint32_t part) const { return items_[parts_[part].items[0]].weight; }
    size_t size(uint32_t part) const { return parts_[part].items.size(); }

    void makeReady(uint32_t part) {
        if (size(part) < lineSlots_) bySize_[size(part)].push_back(part);
        if (size(part) == lineSlots_ || !parts_[part].children.empty()) first_.push(part);
    }
    void place(uint32_t part) {
        isPlaced_[part] = true;
        lines_.back().insert(lines_.back().end(), parts_[part].items.begin(), parts_[part].items.end());
        for (const uint32_t child : parts_[part].children) makeReady(child);
    }
    uint32_t siblingOf(uint32_t part, uint32_t room) const {
        uint32_t best = kNoItem;
        if (parts_[part].parent == kNoItem) return best;
        for (const uint32_t sibling : parts_[parts_[part].parent].children)
            if (!isPlaced_[sibling] && size(sibling) <= room &&
                (best == kNoItem || size(sibling) > size(best)))
                best = sibling;
        return best;
    }
    uint32_t longest(uint32_t room) {
        for (size_t size = std::min<size_t>(room, lineSlots_ - 1); size > 0; --size) {
            std::vector<uint32_t>& parts = bySize_[size];
            while (!parts.empty() && isPlaced_[parts.back()]) parts.pop_back();
            if (!parts.empty()) return parts.back();
        }
        return kNoItem;
    }

    const std::vector<ClusterItem>& items_;
    const std::vector<LinePart>& parts_;
    uint32_t lineSlots_;
    std::vector<std::vector<uint32_t>> bySize_;  // parts that are ready and not full
    std::vector<bool> isPlaced_;
    std::priority_queue<uint32_t, std::vector<uint32_t>, Lighter> first_;
    ClusterLines lines_;
};

}  // namespace

ClusterLines packLines(const std::vector<ClusterItem>& items, uint32_t lineSlots) {
    const std::vector<LinePart> parts = BestParts(items, lineSlots).parts();
    return LinesOfParts(items, parts, lineSlots).lines();
}

ClusterLines growLines(const std::vector<ClusterItem>& items, uint32_t lineSlots) {
    const auto lighter = [&](uint32_t a, uint32_t b) {
        return items[a].weight != items[b].weight ? items[a].weight < items[b].weight : a > b;
    };
    ClusterLines lines, shorter;
    std::vector<uint32_t> roots{0};  // the next one last
    while (!roots.empty()) {
        std::priority_queue<uint32_t, std::vector<uint32_t>, decltype(lighter)> border(lighter);
        border.push(roots.back());
        roots.pop_back();
        std::vector<uint32_t> line;
        while (line.size() < lineSlots && !border.empty()) {
            line.push_back(border.top());
            border.pop();
            for (const uint32_t child : items[line.back()].children)
                if (child != kNoItem) border.push(child);
        }
        const auto behind = std::ptrdiff_t(roots.size());
        for (; !border.empty(); border.pop()) roots.push_back(border.top());
        std::reverse(roots.begin() + behind, roots.end());
        (line.size() == lineSlots ? lines : shorter).push_back(std::move(line));
    }
    // Nothing is below a line that ended short.
    std::stable_sort(shorter.begin(), shorter.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    const size_t full = lines.size();
    for (const std::vector<uint32_t>& line : shorter) {
        size_t at = full;
        while (at < lines.size() && lines[at].size() + line.size() > lineSlots) ++at;
        if (at == lines.size()) lines.emplace_back();
        lines[at].insert(lines[at].end(), line.begin(), line.end());
    }
    return lines;
}

}  // namespace bvhio
