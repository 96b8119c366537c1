// Ours. Connected clusters of at most a page, and in each connected clusters of at most a line, both chosen
// so that rays enter as few as possible (tree/connected_parts.h). Pages follow each other depth first,
// the likeliest at once; of the lines in a page the likeliest whose parent is placed is next.
//
// There is no room to waste: pairs follow each other without gaps, so a line that is not full would push all
// others off their lines. A cluster smaller than a line takes with it the nearest of those waiting that
// complete the line exactly. Where none do, it is held until it completes another one's line, or until those
// that are held fill lines together, cut where lines end. Most such clusters are at the bottom of the tree,
// and nothing waits for them.

#include "relayout/pack.h"

#include <algorithm>
#include <queue>
#include <set>

#include "relayout/pair_tree.h"
#include "tree/connected_parts.h"

namespace bvhio {
namespace {

constexpr uint32_t kNoCluster = PairTree::kNone;
constexpr uint32_t kPageBytes = 4096;
// More pairs than this a cluster of a line does not have; longer lines have several.
constexpr uint32_t kMaxClusterSize = 16;

/// Clusters are called by their first pairs.
class Packer {
  public:
    /// `lineSize` and `pageSize` in pairs.
    Packer(const PairTree& tree, const std::vector<TreeItem>& items, uint32_t lineSize, uint32_t pageSize)
        : tree_(tree),
          lineSize_(lineSize),
          page_(ConnectedParts(items, pageSize).firstItems()),
          top_(ConnectedParts(items, lineSize, page_).firstItems()),
          sizes_(tree.size(), 0),
          placed_(tree.size(), 0),
          waiting_(lineSize) {
        for (const uint32_t top : top_) ++sizes_[top];
        order_.reserve(tree.size());
    }

    std::vector<uint32_t> run() {
        if (tree_.size() == 0) return {};
        wait(0);
        starts_.push_back(0);
        for (;;) {
            while (!starts_.empty()) {
                const uint32_t start = starts_.back();
                starts_.pop_back();
                if (placed_[start] == 0) placePage(start);
            }
            const uint32_t first = firstWaiting();
            if (first == kNoCluster) return std::move(order_);
            placeRegardless(first);
        }
    }

  private:
    bool isLess(uint32_t a, uint32_t b) const {
        return tree_[a].weight != tree_[b].weight ? tree_[a].weight < tree_[b].weight : a > b;
    }

    /// Places the clusters of a page that are below this one, as far as their lines can be completed.
    void placePage(uint32_t start) {
        const auto less = [this](uint32_t a, uint32_t b) { return isLess(a, b); };
        std::priority_queue<uint32_t, std::vector<uint32_t>, decltype(less)> open(less);
        const size_t old = starts_.size();
        for (open.push(start); !open.empty();) {
            const uint32_t next = open.top();
            open.pop();
            if (placed_[next] != 0) continue;
            placeLine(next);
            for (const uint32_t child : exposed_) {
                if (page_[child] == page_[start])
                    open.push(child);
                else
                    starts_.push_back(child);
            }
            exposed_.clear();
        }
        std::sort(starts_.begin() + std::ptrdiff_t(old), starts_.end(), less);
    }

    /// Places a cluster and those that complete its line. Where none do, a full cluster, whose lines are off
    /// already, is placed alone, and another one is not.
    void placeLine(uint32_t cluster) {
        const std::vector<uint32_t> children = childrenOf(cluster);
        stopWaiting(cluster);
        for (const uint32_t child : children) wait(child);
        if (complete(missingAfter(sizes_[cluster]), cluster) || sizes_[cluster] == lineSize_) {
            place(cluster);
            for (const uint32_t part : parts_) place(part);
            parts_.clear();
        } else {
            for (const uint32_t child : children) stopWaiting(child);
            wait(cluster);
            held_.push_back(cluster);
            placeHeld();
        }
    }

    /// Places the last of the held clusters where together they fill lines to the last record. Of as many as
    /// a line has records some do: the sums of two of all beginnings leave the same remainder.
    void placeHeld() {
        std::erase_if(held_, [this](uint32_t cluster) { return placed_[cluster] != 0; });
        uint32_t sum = 0;
        for (size_t first = held_.size(); first-- > 0;) {
            sum += sizes_[held_[first]];
            if (sum % lineSize_ != 0) continue;
            for (size_t i = first; i < held_.size(); ++i) place(held_[i]);
            held_.resize(first);
            return;
        }
    }

    /// When only clusters are left that complete no line: places one, and what fits behind it.
    void placeRegardless(uint32_t cluster) {
        for (uint32_t next = cluster; next != kNoCluster;) {
            place(next);
            next = kNoCluster;
            for (uint32_t size = missingAfter(0); size > 0 && next == kNoCluster; --size)
                next = nearestWaiting(size, cluster);
        }
        starts_.insert(starts_.end(), exposed_.rbegin(), exposed_.rend());
        exposed_.clear();
    }

    /// Finds waiting clusters of `room` pairs together, near a cluster, the largest first: parts_, which no
    /// longer wait.
    bool complete(uint32_t room, uint32_t near, uint32_t largest = kMaxClusterSize) {
        if (room == 0) return true;
        for (uint32_t size = std::min(room, largest); size > 0; --size) {
            const uint32_t part = nearestWaiting(size, near);
            if (part == kNoCluster) continue;
            stopWaiting(part);
            parts_.push_back(part);
            if (complete(room - size, near, size)) return true;
            parts_.pop_back();
            wait(part);
        }
        return false;
    }

    uint32_t missingAfter(uint32_t more) const {
        return (lineSize_ - uint32_t((order_.size() + more) % lineSize_)) % lineSize_;
    }

    /// Full clusters complete no line.
    void wait(uint32_t cluster) {
        if (sizes_[cluster] < lineSize_) waiting_[sizes_[cluster]].insert(cluster);
    }
    void stopWaiting(uint32_t cluster) {
        if (sizes_[cluster] < lineSize_) waiting_[sizes_[cluster]].erase(cluster);
    }
    uint32_t nearestWaiting(uint32_t size, uint32_t to) const {
        const std::set<uint32_t>& clusters = waiting_[size];
        const auto behind = clusters.lower_bound(to);
        if (behind == clusters.begin()) return behind == clusters.end() ? kNoCluster : *behind;
        const uint32_t before = *std::prev(behind);
        return behind != clusters.end() && *behind - to < to - before ? *behind : before;
    }
    uint32_t firstWaiting() const {
        uint32_t first = kNoCluster;
        for (const auto& clusters : waiting_)
            if (!clusters.empty()) first = std::min(first, *clusters.begin());
        return first;
    }

    /// Calls visit(pair) for each of a cluster's pairs, and below(pair) for each cluster right below it.
    template <class Visit, class Below>
    void walk(uint32_t cluster, const Visit& visit, const Below& below) const {
        std::array<uint32_t, kMaxClusterSize + 1> stack{cluster};
        for (uint32_t waiting = 1; waiting > 0;) {
            const uint32_t pair = stack[--waiting];
            visit(pair);
            for (const uint32_t side : {1u, 0u}) {
                const uint32_t child = tree_[pair].children[side];
                if (child == kNoCluster) continue;
                if (top_[child] == cluster)
                    stack[waiting++] = child;
                else
                    below(child);
            }
        }
    }
    std::vector<uint32_t> childrenOf(uint32_t cluster) const {
        std::vector<uint32_t> children;
        walk(
            cluster, [](uint32_t) {}, [&](uint32_t child) { children.push_back(child); });
        return children;
    }
    void place(uint32_t cluster) {
        placed_[cluster] = 1;
        stopWaiting(cluster);
        walk(
            cluster, [&](uint32_t pair) { order_.push_back(pair); },
            [&](uint32_t child) {
                exposed_.push_back(child);
                wait(child);
            });
    }

    const PairTree& tree_;
    uint32_t lineSize_;
    std::vector<uint32_t> page_;               // the page of each pair
    std::vector<uint32_t> top_;                // its cluster
    std::vector<uint32_t> sizes_;              // of clusters
    std::vector<uint8_t> placed_;              // clusters
    std::vector<std::set<uint32_t>> waiting_;  // clusters below what is placed, by size
    std::vector<uint32_t> starts_;             // of pages to come, the next at the back
    std::vector<uint32_t> exposed_;            // clusters below what was placed last
    std::vector<uint32_t> held_;               // clusters that nothing completed, fewer than lineSize_
    std::vector<uint32_t> parts_;
    std::vector<uint32_t> order_;
};

}  // namespace

LayoutResult layoutPack(const Bvh& bvh, const LayoutOptions& options) {
    const PairTree tree(bvh, options.weights);
    const uint32_t perLine = options.recordsPerLine();
    const uint32_t clustersPerLine = (perLine + kMaxClusterSize - 1) / kMaxClusterSize;
    const uint32_t lineSize = perLine / clustersPerLine;
    const uint32_t pageSize = std::max(lineSize, kPageBytes / options.recordBytes);
    return {tree.nodeOrder(Packer(tree, tree.items(), lineSize, pageSize).run())};
}

}  // namespace bvhio
