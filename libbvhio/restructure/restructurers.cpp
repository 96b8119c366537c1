#include "restructure/restructurers.h"

#include "restructure/none.h"
#include "restructure/reinsertion.h"

namespace bvhio {

std::span<const Restructurer> restructurers() {
    static constexpr Restructurer kTable[] = {
        {"reinsertion", "move subtrees to where they cost least: the best cost", restructureReinsertion},
        {"none", "leave the tree as it is", restructureNone},
    };
    return kTable;
}

}  // namespace bvhio
