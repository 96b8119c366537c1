#include "restructure/restructurers.h"

#include "restructure/none.h"

namespace bvhio {

std::span<const Restructurer> restructurers() {
    static constexpr Restructurer kTable[] = {
        {"none", "leave the tree as it is", restructureNone},
    };
    return kTable;
}

}  // namespace bvhio
