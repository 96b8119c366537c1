// Bittner, Hapala and Havran 2013, "Fast insertion-based optimization of bounding volume hierarchies", in
// parallel as in Meister and Bittner 2018, "Parallel reinsertion for bounding volume hierarchy optimization":
// a subtree is taken out and put back where the tree costs least. Departures:
// - A pass looks at some of the subtrees only, those that promise most, and at none again for which it found
//   no better place until something about that one changed. When none are left, all get another chance; when
//   that finds nothing either, the tree is as good as this method can make it.
// - The places are found in parallel, by areas alone, in batches over a tree that rests meanwhile. Then the
//   moves are made one by one, the greatest gain first. Instead of looking for conflicts between them, each
//   is judged again in the tree as it is by then, and by the cost that the tree will have once leaves are
//   formed: what lowers the one often does not lower the other.

#include "restructure/reinsertion.h"

#include <algorithm>

#include "core/parallel.h"
#include "restructure/reinsertion_candidates.h"
#include "restructure/reinsertion_moves.h"
#include "restructure/reinsertion_search.h"

namespace bvhio {
namespace {

constexpr uint32_t kIterations = 6;
constexpr size_t kPart = 20, kFewest = 1024;  // of the nodes a pass looks at one in kPart, or this many
constexpr uint32_t kBatches = 4;
constexpr size_t kGrain = 128;

struct Move {
    float gain;
    uint32_t moved, beside;

    bool operator<(const Move& other) const {
        return gain != other.gain ? gain > other.gain : moved < other.moved;
    }
};

class Reinsertion {
  public:
    explicit Reinsertion(TreeEditor& tree)
        : tree_(tree),
          scale_(areaScale(tree[0].bounds)),
          candidates_(tree, scale_),
          moves_(tree, candidates_.flags()) {}

    /// One pass; returns false when there is nothing left to do.
    bool iterate(uint64_t& changes) {
        const std::vector<uint32_t>& selected = candidates_.select(std::max(tree_.size() / kPart, kFewest));
        if (selected.empty()) {
            if (!changedSinceAll_) return false;
            changedSinceAll_ = false;
            candidates_.flagAll();
            return iterate(changes);
        }
        for (uint32_t batch = 0; batch < kBatches; ++batch) {
            // Neighbours change each other's chances, so they come one after the other.
            batch_.clear();
            for (const uint32_t slot : selected)
                if (slot % kBatches == batch) batch_.push_back(slot);
            changes += process();
        }
        changedSinceAll_ |= changes > 0;
        return true;
    }

    size_t bytes() const {
        return candidates_.bytes() + moves_.bytes() + batch_.capacity() * sizeof(uint32_t) +
               places_.capacity() * sizeof(Place) + found_.capacity() * sizeof(Move);
    }

  private:
    /// Finds places for the batch, then moves what still gains.
    uint64_t process() {
        places_.resize(batch_.size());
        parallelChunks(batch_.size(), kGrain, [&](size_t begin, size_t end) {
            findPlaces(tree_, scale_, {batch_.data() + begin, end - begin}, places_.data() + begin);
        });
        found_.clear();
        for (size_t i = 0; i < batch_.size(); ++i) {
            candidates_.flags()[batch_[i]] = 0;
            if (places_[i].gain > 0) found_.push_back({places_[i].gain, batch_[i], places_[i].beside});
        }
        std::sort(found_.begin(), found_.end());
        uint64_t changes = 0;
        for (const Move& move : found_) {
            if (moves_.move(move.moved, move.beside))
                ++changes;
            else if (changes > 0)
                candidates_.flags()[move.moved] = 1;
        }
        return changes;
    }

    TreeEditor& tree_;
    const float scale_;
    Candidates candidates_;
    SubtreeMoves moves_;
    bool changedSinceAll_ = false;
    std::vector<uint32_t> batch_;
    std::vector<Place> places_;
    std::vector<Move> found_;
};

}  // namespace

Restructured restructureReinsertion(const Scene& scene, const Bvh& bvh, const RestructureOptions& options) {
    TreeEditor tree(scene, bvh, options);
    const uint32_t iterations = options.iterations != 0 ? options.iterations : kIterations;
    if (options.progress) options.progress->start(iterations);
    Reinsertion reinsertion(tree);
    for (uint32_t i = 0; i < iterations; ++i) {
        uint64_t changes = 0;
        if (!reinsertion.iterate(changes)) break;
        tree.endIteration(changes);
        if (options.progress) options.progress->add(1);
    }
    return std::move(tree).finish(reinsertion.bytes());
}

}  // namespace bvhio
