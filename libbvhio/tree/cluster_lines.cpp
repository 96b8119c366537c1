#include "tree/cluster_lines.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <queue>

namespace bvhio {
namespace {

constexpr uint32_t kNone = TreeItem::kNone;

/// Puts connected parts into lines. A part may be placed once its parent is, so that items stay behind their
/// parents. Parts that others wait for and full ones open lines, the heaviest first; what room they leave is
/// filled from the rest: siblings first, then the longest that fits. Where none does, the line ends short
/// as long as slots may be spared, and then takes as many items as it has room for of the part that loses
/// least so.
class LinesOfParts {
  public:
    LinesOfParts(std::span<const TreeItem> items, uint32_t lineSlots, size_t spareSlots)
        : items_(items),
          lineSlots_(lineSlots),
          spareSlots_(spareSlots),
          best_(items, lineSlots),
          bySize_(lineSlots),
          first_(Lighter{*this}) {
        makeReady(0, kNone);
        for (uint32_t part = next(); part != kNone; part = next()) {
            lines_.emplace_back();
            place(part, size(part));
            while (uint32_t room = lineSlots_ - uint32_t(lines_.back().size())) {
                uint32_t other = siblingOf(part, room);
                if (other == kNone) other = longest(room);
                if (other != kNone)
                    room = size(other);
                else if (room > spareSlots_)
                    other = cheapestOf(room);
                if (other == kNone) {
                    spareSlots_ -= std::min<size_t>(room, spareSlots_);
                    break;
                }
                place(other, room);
            }
        }
    }
    ClusterLines lines() && { return std::move(lines_); }

  private:
    struct Part {
        uint32_t item;    // its first
        uint32_t parent;  // the part that has that one's parent
        bool isPlaced = false;
        std::vector<uint32_t> children{};  // parts, once it is placed
    };
    struct Lighter {
        const LinesOfParts& lines;
        bool operator()(uint32_t a, uint32_t b) const {
            const double weightOfA = lines.weight(a), weightOfB = lines.weight(b);
            return weightOfA != weightOfB ? weightOfA < weightOfB : a > b;
        }
    };
    double weight(uint32_t part) const { return items_[parts_[part].item].weight; }
    uint32_t size(uint32_t part) const { return best_.bestSize(parts_[part].item); }

    void makeReady(uint32_t item, uint32_t parent) {
        const auto part = uint32_t(parts_.size());
        parts_.push_back({item, parent});
        if (size(part) < lineSlots_) bySize_[size(part)].push_back(part);
        if (size(part) == lineSlots_ || size(part) < best_.mostItems(item)) first_.push(part);
    }
    /// As many items of the part, in the last line.
    void place(uint32_t part, uint32_t size) {
        parts_[part].isPlaced = true;
        const auto from = uint32_t(parts_.size());
        placeItems(part, parts_[part].item, size);
        for (uint32_t child = from; child < parts_.size(); ++child) parts_[part].children.push_back(child);
    }
    void placeItems(uint32_t part, uint32_t item, uint32_t size) {
        lines_.back().push_back(item);
        const uint32_t onTheLeft = best_.sizeOnTheLeft(item, size);
        const uint32_t shares[2] = {onTheLeft, size - 1 - onTheLeft};
        for (size_t side = 0; side < 2; ++side) {
            const uint32_t child = items_[item].children[side];
            if (child == kNone) continue;
            if (shares[side] > 0)
                placeItems(part, child, shares[side]);
            else
                makeReady(child, part);
        }
    }

    /// To open a line.
    uint32_t next() {
        while (!first_.empty()) {
            const uint32_t part = first_.top();
            first_.pop();
            if (!parts_[part].isPlaced) return part;
        }
        return longest(lineSlots_ - 1);
    }
    uint32_t siblingOf(uint32_t part, uint32_t room) const {
        uint32_t best = kNone;
        if (parts_[part].parent == kNone) return best;
        for (const uint32_t sibling : parts_[parts_[part].parent].children)
            if (!parts_[sibling].isPlaced && size(sibling) <= room &&
                (best == kNone || size(sibling) > size(best)))
                best = sibling;
        return best;
    }
    uint32_t longest(uint32_t room) {
        for (size_t size = std::min(room, lineSlots_ - 1); size > 0; --size) {
            std::vector<uint32_t>& parts = bySize_[size];
            while (!parts.empty() && parts_[parts.back()].isPlaced) parts.pop_back();
            if (!parts.empty()) return parts.back();
        }
        return kNone;
    }
    /// When all that are ready have more than `size` items: the one whose cost grows least with so many.
    uint32_t cheapestOf(uint32_t size) const {
        uint32_t best = kNone;
        double least = std::numeric_limits<double>::infinity();
        for (uint32_t part = 0; part < parts_.size(); ++part) {
            if (parts_[part].isPlaced) continue;
            const uint32_t item = parts_[part].item;
            const double loss = best_.cost(item, size) - best_.cost(item, best_.bestSize(item));
            if (loss < least) {
                least = loss;
                best = part;
            }
        }
        return best;
    }

    std::span<const TreeItem> items_;
    uint32_t lineSlots_;
    size_t spareSlots_;
    ConnectedParts best_;
    std::vector<Part> parts_;                    // those that are placed, or ready for it
    std::vector<std::vector<uint32_t>> bySize_;  // parts that are ready and not full
    std::priority_queue<uint32_t, std::vector<uint32_t>, Lighter> first_;
    ClusterLines lines_;
};

}  // namespace

ClusterLines packLines(std::span<const TreeItem> items, uint32_t lineSlots, uint32_t maxSlots) {
    return LinesOfParts(items, lineSlots, maxSlots - items.size()).lines();
}

ClusterLines growLines(std::span<const TreeItem> items, uint32_t lineSlots) {
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
                if (child != kNone) border.push(child);
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
