// Bittner, Hapala and Havran 2013, "Fast insertion-based optimization of bounding volume hierarchies", in
// parallel as in Meister and Bittner 2018, "Parallel reinsertion for bounding volume hierarchy optimization":
// a subtree is taken out and put back at the place where the tree costs least. Departures:
//
// - A pass only looks at the most promising subtrees. A subtree without a better place is not looked at again
//   until its box, its place or its neighbourhood changes. When no such subtrees are left, all get another
//   chance.
// - Places are searched in parallel, by areas alone, in batches during which the tree does not change. Then
//   the moves are made one by one, the greatest gain first. There is no search for conflicts between moves.
//   Instead each move is judged again in the tree at that time, by the cost that the tree will have once
//   leaves are formed: a move that lowers the sum of areas often does not lower this cost.
// - If no single move helps, several moves at once may (reinsertion_treelet.h), above all among the few nodes
//   near the root, on which the cost depends most.

#include "restructure/reinsertion.h"

#include <algorithm>

#include "core/parallel.h"
#include "restructure/reinsertion_candidates.h"
#include "restructure/reinsertion_moves.h"
#include "restructure/reinsertion_search.h"
#include "restructure/reinsertion_treelet.h"

namespace bvhio {
namespace {

constexpr uint32_t kIterations = 4;
constexpr size_t kPart = 20, kFewest = 1024;  // a pass looks at one in kPart nodes, but at least kFewest
constexpr uint32_t kBatches = 4;
constexpr size_t kMovesPerTask = 128;
// Treelets: the number of passes before them, their leaves, and the number of the tree's slots for each step
// of a pass.
constexpr uint32_t kPassesBefore = 2, kTreeletLeaves = 512, kSlotsPerStep = 64, kFewestSteps = 32;
constexpr uint32_t kCuts =
    3;  // ways to cut the tree, each with four times as many treelets as the one before
constexpr uint32_t kIdle = 16;  // passes without a change after which the search ends

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
          scale_(extentScale(tree[0].bounds)),
          candidates_(tree, scale_),
          moves_(tree, candidates_.flags()) {}

    /// Runs one pass, and returns the number of changes.
    uint64_t iterate() {
        uint64_t changes = pass_ < kPassesBefore ? 0 : recreateTreelets();
        const std::vector<uint32_t>& selected = select();
        for (uint32_t batch = 0; batch < kBatches; ++batch) {
            // Moves of neighbours affect each other, so neighbours are in different batches.
            batch_.clear();
            for (const uint32_t slot : selected)
                if (slot % kBatches == batch) batch_.push_back(slot);
            changes += moveBatch();
        }
        ++pass_;
        changedSinceAll_ |= changes > 0;
        idle_ = changes > 0 ? 0 : idle_ + 1;
        return changes;
    }

    bool done() const { return idle_ == kIdle; }

    size_t bytes() const {
        return candidates_.bytes() + moves_.bytes() + batch_.capacity() * sizeof(uint32_t) +
               places_.capacity() * sizeof(Place) + found_.capacity() * sizeof(Move);
    }

  private:
    /// Selects the subtrees to look at. If none are left, starts again with all.
    const std::vector<uint32_t>& select() {
        const size_t wanted = std::max(tree_.size() / kPart, kFewest);
        const std::vector<uint32_t>& selected = candidates_.select(wanted);
        if (!selected.empty() || !changedSinceAll_) return selected;
        changedSinceAll_ = false;
        candidates_.flagAll();
        return candidates_.select(wanted);
    }

    /// Finds places for the subtrees of a batch, and makes those moves that still lower the cost.
    uint64_t moveBatch() {
        places_.resize(batch_.size());
        parallelChunks(batch_.size(), kMovesPerTask, [&](size_t begin, size_t end) {
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

    /// Improves treelets. Half of the steps are for the treelet at the root. The other half is for treelets
    /// below it, as many as the steps suffice for; the next pass continues with the next ones.
    uint64_t recreateTreelets() {
        // The treelet at the root.
        const size_t steps = std::max<size_t>(tree_.size() / kSlotsPerStep, kFewestSteps);
        ReinsertionTreelet top(moves_, 0, kTreeletLeaves);
        Random random(pass_);
        uint64_t changes = top.improve(uint32_t(steps / 2), random);
        if (changes > 0) top.write(moves_);

        // The roots of the treelets below it.
        uint32_t cut = pass_ % kCuts;
        while (cut > 0 && (kTreeletLeaves << 2 * cut) * 32 > tree_.size()) --cut;
        const std::vector<uint32_t> all =
            cut == 0 ? top.openLeaves(moves_)
                     : ReinsertionTreelet(moves_, 0, kTreeletLeaves << 2 * cut).openLeaves(moves_);
        std::vector<uint32_t> roots(std::min(all.size(), steps / 2 / kTreeletLeaves));
        for (uint32_t& root : roots) root = all[next_[cut]++ % all.size()];

        // Improve these in parallel, and then update the nodes above them.
        std::vector<uint32_t> changesOf(roots.size());
        parallelChunks(roots.size(), 1, [&](size_t i, size_t) {
            ReinsertionTreelet treelet(moves_, roots[i], kTreeletLeaves);
            Random ownRandom(pass_, roots[i]);
            changesOf[i] = treelet.improve(treelet.leaves(), ownRandom);
            if (changesOf[i] > 0) treelet.write(moves_);
        });
        for (size_t i = 0; i < roots.size(); ++i) {
            if (changesOf[i] == 0) continue;
            changes += changesOf[i];
            moves_.update(tree_.parent(roots[i]));
        }
        return changes;
    }

    TreeEditor& tree_;
    const float scale_;
    Candidates candidates_;
    SubtreeMoves moves_;
    uint32_t pass_ = 0, idle_ = 0;
    bool changedSinceAll_ = false;  // whether something changed since all subtrees were candidates
    size_t next_[kCuts] = {};
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
    uint32_t made = 0;
    for (; made < iterations && !reinsertion.done(); ++made) {
        tree.endIteration(reinsertion.iterate());
        if (options.progress) options.progress->add(1);
    }
    if (options.progress) options.progress->add(iterations - made);
    return std::move(tree).finish(reinsertion.bytes());
}

}  // namespace bvhio
