// Look-up tables for steps through trees of the mvh form: the cuts of children by their codes.
#pragma once

#include <array>

#include "compress/mvh_tree.h"

namespace bvhio {

/// The tables of a rule. All trees with the same rule share them.
class MvhTables {
  public:
    explicit MvhTables(const MvhRule& rule) : axes(rule.axes) {
        for (uint32_t codes = 0; codes < 16; ++codes)
            for (uint32_t lane = 0; lane < 4; ++lane) {
                fill(rule, codes >> (lane < 2 ? 0 : 2) & 3, lane, children[codes]);
                if (lane < 2) fill(rule, codes >> 2 * lane & 3, lane, grandchildren[codes]);
            }
    }

    /// For each lane: `low` is how far the near plane moves for a ray that goes up the axis, as a part of the
    /// box's size; xor with `swap` gives the same for the far plane; `none` is all ones if the code is none.
    template <size_t lanes>
    struct Lanes {
        alignas(4 * lanes) std::array<float, lanes> low;
        std::array<uint32_t, lanes> swap, none;
    };
    uint32_t axes;
    Lanes<4> children[16];       // by a nibble: left, left, right, right
    Lanes<2> grandchildren[16];  // by a nibble: left, right

  private:
    template <size_t lanes>
    static void fill(const MvhRule& rule, uint32_t code, uint32_t lane, Lanes<lanes>& to) {
        const float zeta = code == kMvhBoth ? rule.zetaOfBoth : rule.zeta;
        to.low[lane] = code & kMvhLow ? zeta : 0;
        to.swap[lane] =
            std::bit_cast<uint32_t>(to.low[lane]) ^ std::bit_cast<uint32_t>(code & kMvhHigh ? zeta : 0.0f);
        to.none[lane] = code == kMvhNone ? ~0u : 0;
    }
};

}  // namespace bvhio
