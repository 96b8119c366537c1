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
        {"odfs", "depth first, the likelier subtree before the other", {layoutOdfs, kUsesWeights}},
        {"swst", "swapped subtrees: the same as odfs, a name for it by visits", {layoutOdfs, kUsesWeights}},
        {"bfs", "breadth first: level after level", {layoutBfs, kUsesNothing}},
        {"veb",
         "van Emde Boas: the upper half first, then each subtree, all of them so again",
         {layoutVeb, kUsesNothing}},
        {"tdfs",
         "treelets of likely children, each depth first",
         {layoutTdfs, kUsesWeights | kUsesThreshold | kUsesTreeletSize}},
        {"tbfs",
         "treelets of likely children, each breadth first",
         {layoutTbfs, kUsesWeights | kUsesLines | kUsesThreshold | kUsesTreeletSize}},
        {"col",
         "Yoon and Manocha: the likeliest part first, then each subtree, all of them so again",
         {layoutCol, kUsesWeights}},
        {"pack",
         "lines of connected pairs that rays enter least often, in pages: fewest cache misses",
         {layoutPack, kUsesWeights | kUsesLines}},
        {"clusters",
         "clusters for records of 8 bytes with short pointers, cut at the least cost",
         {layoutClusters, kUsesWeights | kUsesLineSize | kUsesPointerBits}},
        {"clusters-paper",
         "the same as their paper grows them",
         {layoutClustersAsPaper, kUsesWeights | kUsesLineSize | kUsesPointerBits}},
    };
    return kTable;
}

}  // namespace bvhio
