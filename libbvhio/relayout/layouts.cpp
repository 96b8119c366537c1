#include "relayout/layouts.h"

#include "relayout/dfs.h"

namespace bvhio {

std::span<const Layout> layouts() {
    static constexpr Layout kTable[] = {
        {"dfs", "depth first: each pair, its left subtree, its right subtree", orderDepthFirst},
    };
    return kTable;
}

}  // namespace bvhio
