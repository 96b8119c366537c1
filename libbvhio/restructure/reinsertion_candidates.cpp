#include "restructure/reinsertion_candidates.h"

#include <bit>
#include <cstring>

#include "core/parallel.h"

namespace bvhio {
namespace {

float halfAreaOf(const Node& node, float scale) {
    // Coordinates are scaled before they are subtracted: otherwise extents may exceed a float, and there is
    // no bin for values that are not numbers.
    const float x = node.bounds.max.x * scale - node.bounds.min.x * scale,
                y = node.bounds.max.y * scale - node.bounds.min.y * scale,
                z = node.bounds.max.z * scale - node.bounds.min.z * scale;
    return x * y + y * z + z * x;
}

/// Returns the promise of a node: the gain from the parent's removal alone, and more for a small node that
/// makes its parent large (Bittner et al. 2013, 3.3, use such ratios too).
float promiseOf(float area, float parentArea) {
    const float promise = (parentArea - area) * parentArea / (area + 0.01f * parentArea);
    return promise > 0 ? promise : 0;  // 0 if areas are so small that the promise is not a number
}

}  // namespace

Candidates::Candidates(const TreeEditor& tree, float scale)
    : tree_(tree), scale_(scale), flags_(tree.size()), promises_(tree.size()) {
    flagAll();
}

void Candidates::flagAll() {
    std::memset(flags_.data(), 1, flags_.size());
}

size_t Candidates::bytes() const {
    return flags_.size() * (sizeof(uint8_t) + sizeof(float)) + selected_.capacity() * sizeof(uint32_t);
}

/// Rates the flagged slots of a chunk of pairs, and counts them in bins of similar promise.
void Candidates::rate(size_t begin, size_t end, uint32_t* bins) {
    for (size_t pair = begin; pair < end; pair += 2) {
        promises_[pair] = promises_[pair + 1] = -1;
        if (pair == 0 || (flags_[pair] | flags_[pair + 1]) == 0) continue;
        const float parentArea = halfAreaOf(tree_[tree_.parent(uint32_t(pair))], scale_);
        for (const size_t slot : {pair, pair + 1}) {
            if (flags_[slot] == 0) continue;
            promises_[slot] = promiseOf(halfAreaOf(tree_[uint32_t(slot)], scale_), parentArea);
            ++bins[std::bit_cast<uint32_t>(promises_[slot]) >> 19];
        }
    }
}

const std::vector<uint32_t>& Candidates::select(size_t wanted) {
    // Rate all flagged slots.
    const size_t size = tree_.size(), chunks = (size + kGrain - 1) / kGrain;
    bins_.assign(chunks * kBins, 0);
    parallelChunks(size, kGrain, [&](size_t begin, size_t end) {
        rate(begin, end, bins_.data() + begin / kGrain * kBins);
    });

    // Find the lowest bin to take slots from. All slots of higher bins are taken, and as many of the lowest
    // bin as are still wanted.
    size_t last = kBins, above = 0, in = 0;
    do {
        above += in;
        --last;
        in = 0;
        for (size_t chunk = 0; chunk < chunks; ++chunk) in += bins_[chunk * kBins + last];
    } while (last > 0 && above + in < wanted);
    size_t fromLast = std::min(in, wanted - above);

    // Divide the slots of the lowest bin among the chunks, and find where the slots of each chunk go.
    const float least = std::bit_cast<float>(uint32_t(last) << 19),
                more = std::bit_cast<float>(uint32_t(last + 1) << 19);
    std::vector<size_t> ends(chunks), quotas(chunks);
    size_t total = 0;
    for (size_t chunk = 0; chunk < chunks; ++chunk) {
        const uint32_t* bins = bins_.data() + chunk * kBins;
        quotas[chunk] = std::min<size_t>(fromLast, bins[last]);
        fromLast -= quotas[chunk];
        total += quotas[chunk];
        for (size_t bin = last + 1; bin < kBins; ++bin) total += bins[bin];
        ends[chunk] = total;
    }

    // Copy the selected slots.
    selected_.resize(total);
    parallelChunks(size, kGrain, [&](size_t begin, size_t end) {
        size_t quota = quotas[begin / kGrain], at = begin == 0 ? 0 : ends[begin / kGrain - 1];
        for (size_t i = begin; i < end; ++i) {
            if (!(promises_[i] >= least)) continue;
            if (!(promises_[i] >= more)) {
                if (quota == 0) continue;
                --quota;
            }
            selected_[at++] = uint32_t(i);
        }
    });
    return selected_;
}

}  // namespace bvhio
