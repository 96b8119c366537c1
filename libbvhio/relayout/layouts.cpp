#include "relayout/layouts.h"

#include "relayout/bfs.h"
#include "relayout/dfs.h"
#include "relayout/odfs.h"

namespace bvhio {

std::span<const Layout> layouts() {
    static constexpr Layout kTable[] = {
        {"dfs", "depth first: each pair, its left subtree, its right subtree", {layoutDfs, kUsesNothing}},
        {"odfs", "depth first, the likelier subtree before the other", {layoutOdfs, kUsesWeights}},
        {"bfs", "breadth first: level after level", {layoutBfs, kUsesNothing}},
    };
    return kTable;
}

}  // namespace bvhio
