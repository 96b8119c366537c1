// Treelets that grow depth first (relayout/layout_treelets.cpp).

#include "relayout/tdfs.h"

#include "relayout/layout_treelets.h"

namespace bvhio {

LayoutResult layoutTdfs(const Bvh& bvh, const LayoutOptions& options) {
    const PairTree tree(bvh, options.weights);
    const double threshold = options.threshold < 0 ? kTdfsThreshold : options.threshold;
    const uint32_t maxPairs = options.treeletSize == 0 ? ~uint32_t(0) : options.treeletSize;
    return {tree.nodeOrder(orderTreelets(tree, {TreeletGrowth::depthFirst, threshold, maxPairs}))};
}

}  // namespace bvhio
