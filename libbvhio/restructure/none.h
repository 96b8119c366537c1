// The restructurer that changes nothing, as a baseline for the others.
#pragma once

#include "restructure/restructurers.h"

namespace bvhio {

inline Restructured restructureNone(const Scene&, const Bvh& bvh, const RestructureOptions&) {
    return {bvh, {}, 0, 0};
}

}  // namespace bvhio
