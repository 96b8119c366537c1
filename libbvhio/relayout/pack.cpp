// Our own method. The tree is divided into connected clusters of at most a page, and each of these into
// connected clusters of at most a line, both chosen so that rays enter as few as possible
// (tree/connected_parts.h). Pages are in depth-first order, the likeliest first. Within a page, the next line
// is the likeliest one whose parent is placed.
//
// There are no gaps between pairs, so a line that is not full would shift all later clusters off their lines.
// A cluster smaller than a line is placed together with the nearest waiting clusters that complete the line
// exactly. If no clusters do, it is held until it completes the line of another cluster, or until the held
// clusters fill whole lines together. Most such clusters are at the bottom of the tree, and no other clusters
// wait for them.

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
// The most pairs of a cluster. Longer lines have several clusters.
constexpr uint32_t kMaxClusterSize = 16;

/// Places clusters of pairs. The number of a cluster is that of its first pair.
class Packer {
  public:
    /// `lineSize` and `pageSize` are in pairs.
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

    /// Places the cluster `start` and the clusters of its page below it, as far as their lines can be
    /// completed.
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

    /// Places a cluster and the clusters that complete its line. If no clusters do, a full cluster is placed
    /// alone, since its pairs are off their lines already; other clusters are held.
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

    /// Places the last of the held clusters if together they fill whole lines. Among as many held clusters as
    /// a line has records, some consecutive ones do, because two of the partial sums of sizes leave the same
    /// remainder.
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

    /// Places a cluster, and clusters that fit after it, when no cluster is left that completes a line.
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

    /// Finds waiting clusters near a cluster that have `room` pairs together, the largest first. Moves them
    /// to parts_. Returns whether there are such clusters.
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

    /// Lets a cluster wait to complete a line. Full clusters do not wait, since they cannot.
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
    std::vector<uint32_t> top_;                // the cluster of each pair
    std::vector<uint32_t> sizes_;              // of clusters
    std::vector<uint8_t> placed_;              // whether each cluster is placed
    std::vector<std::set<uint32_t>> waiting_;  // clusters below placed ones, by size
    std::vector<uint32_t> starts_;             // first clusters of the next pages; the next is the last
    std::vector<uint32_t> exposed_;            // clusters below the one that was placed last
    std::vector<uint32_t> held_;               // clusters that no others completed, fewer than lineSize_
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
