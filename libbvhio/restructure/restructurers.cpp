#include "restructure/restructurers.h"

#include "restructure/atr.h"
#include "restructure/none.h"
#include "restructure/reinsertion.h"
#include "restructure/tr.h"

namespace bvhio {

std::span<const Restructurer> restructurers() {
    static constexpr Restructurer kTable[] = {
        {"reinsertion",
         "move subtrees to the places of least cost: the cheapest trees",
         {restructureReinsertion, kUsesIterations | kUsesLeaves}},
        {"atr",
         "rebuild treelets by agglomeration: about as good as tr, and faster",
         {restructureAtr, kUsesIterations | kUsesTreelets | kUsesLeaves}},
        {"tr",
         "rebuild treelets, each with the least cost",
         {restructureTr, kUsesIterations | kUsesTreelets | kUsesLeaves}},
        {"none", "leave the tree as it is", {restructureNone, kUsesNothing}},
    };
    return kTable;
}

}  // namespace bvhio
