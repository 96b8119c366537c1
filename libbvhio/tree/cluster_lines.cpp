#include "tree/cluster_lines.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <queue>

namespace bvhio {
namespace {

constexpr uint32_t kNone = TreeItem::kNone;

/// Puts connected parts into lines. A part is ready to be placed once its parent is placed, so that items
/// come after their parents. Full parts, and parts that others wait for, open lines, the heaviest first. The
/// room they leave is filled with siblings first, and then with the longest part that fits. If none fits, the
/// line ends short while there are slots to spare. After that, the line takes as many items as it has room
/// for from the part whose cost grows least by this.
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
        uint32_t item;    // the first of the part
        uint32_t parent;  // the part that holds the first item's parent
        bool isPlaced = false;
        std::vector<uint32_t> children{};  // parts; known once this part is placed
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
    /// Places `size` items of the part in the last line.
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

    /// Returns the part that opens the next line.
    uint32_t next() {
        while (!first_.empty()) {
            const uint32_t part = first_.top();
            first_.pop();
            if (!parts_[part].isPlaced) return part;
        }
        return longest(lineSlots_ - 1);
    }
    /// Returns the longest sibling of the part that fits.
    uint32_t siblingOf(uint32_t part, uint32_t room) const {
        uint32_t best = kNone;
        if (parts_[part].parent == kNone) return best;
        for (const uint32_t sibling : parts_[parts_[part].parent].children)
            if (!parts_[sibling].isPlaced && size(sibling) <= room &&
                (best == kNone || size(sibling) > size(best)))
                best = sibling;
        return best;
    }
    /// Returns the longest part that is ready and fits.
    uint32_t longest(uint32_t room) {
        for (size_t size = std::min(room, lineSlots_ - 1); size > 0; --size) {
            std::vector<uint32_t>& parts = bySize_[size];
            while (!parts.empty() && parts_[parts.back()].isPlaced) parts.pop_back();
            if (!parts.empty()) return parts.back();
        }
        return kNone;
    }
    /// Returns the part whose cost grows least if only `size` items of it are placed, for when all parts that
    /// are ready have more items.
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
    std::vector<Part> parts_;                    // placed or ready
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
    std::vector<uint32_t> roots{0};  // of lines; the next is the last
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
    // Short lines share lines. They have nothing below them, so they may come last.
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
