// The default restructurer: moves subtrees to the places where they cost least.
#pragma once

#include "restructure/restructurers.h"

namespace bvhio {

Restructured restructureReinsertion(const Scene& scene, const Bvh& bvh, const RestructureOptions& options);

}  // namespace bvhio
