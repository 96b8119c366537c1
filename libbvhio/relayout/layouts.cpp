#include "relayout/layouts.h"

#include "relayout/bfs.h"
#include "relayout/clusters.h"
#include "relayout/col.h"
#include "relayout/dfs.h"
#include "relayout/odfs.h"
#include "relayout/pack.h"
#include "relayout/tbfs.h"
#include "relayout/tdfs.h"
#include "relayout/veb.h"

namespace bvhio {

std::span<const Layout> layouts() {
    static constexpr Layout kTable[] = {
        {"dfs", "depth first: each pair, its left subtree, its right subtree", {layoutDfs, kUsesNothing}},
        {"odfs", "depth first, the likelier subtree first", {layoutOdfs, kUsesWeights}},
        {"swst", "swapped subtrees: another name of odfs, for weights by visits", {layoutOdfs, kUsesWeights}},
        {"bfs", "breadth first: level by level", {layoutBfs, kUsesNothing}},
        {"veb", "van Emde Boas order: top half, then each subtree, recursively", {layoutVeb, kUsesNothing}},
        {"tdfs",
         "treelets of probable children, each depth first",
         {layoutTdfs, kUsesWeights | kUsesThreshold | kUsesTreeletSize}},
        {"tbfs",
         "treelets of probable children, each breadth first",
         {layoutTbfs, kUsesWeights | kUsesLines | kUsesThreshold | kUsesTreeletSize}},
        {"col",
         "Yoon and Manocha: the likeliest part, then each subtree, recursively",
         {layoutCol, kUsesWeights}},
        {"pack",
         "lines of connected pairs, entered as rarely as possible, in pages: fewest cache misses",
         {layoutPack, kUsesWeights | kUsesLines}},
        {"clusters",
         "clusters for 8-byte records with short pointers, cut at the least cost",
         {layoutClusters, kUsesWeights | kUsesLineSize | kUsesPointerBits}},
        {"clusters-paper",
         "the same clusters, cut as in their paper",
         {layoutClustersAsPaper, kUsesWeights | kUsesLineSize | kUsesPointerBits}},
    };
    return kTable;
}

}  // namespace bvhio
