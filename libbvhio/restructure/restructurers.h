// The table of restructurers: they change which nodes a tree has, to lower its cost.
#pragma once

#include "core/bvh.h"
#include "core/choice.h"
#include "core/sah_cost.h"

namespace bvhio {

struct RestructureOptions {
    SahCosts costs;
};

/// A restructurer returns a tree over the same primitives that keeps every invariant of Bvh and never costs
/// more, whose bytes depend on the tree and the options alone: not on the number of threads, the compiler or
/// the processor.
using Restructurer = Choice<Bvh (*)(const Bvh&, const RestructureOptions&)>;

/// All restructurers, the default first.
std::span<const Restructurer> restructurers();

}  // namespace bvhio
