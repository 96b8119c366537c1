// Treelets that grow breadth first (relayout/layout_treelets.cpp).

#include "relayout/tbfs.h"

#include "relayout/layout_treelets.h"

namespace bvhio {

LayoutResult layoutTbfs(const Bvh& bvh, const LayoutOptions& options) {
    const PairTree tree(bvh, options.weights);
    const double threshold = options.threshold < 0 ? kTbfsThreshold : options.threshold;
    const uint32_t maxPairs = options.treeletSize == 0 ? options.recordsPerLine() : options.treeletSize;
    return {tree.nodeOrder(orderTreelets(tree, {TreeletGrowth::breadthFirst, threshold, maxPairs}))};
}

}  // namespace bvhio
