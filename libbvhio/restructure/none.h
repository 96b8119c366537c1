// The restructurer that changes nothing: what others are measured against.
#pragma once

#include "restructure/restructurers.h"

namespace bvhio {

inline Bvh restructureNone(const Bvh& bvh, const RestructureOptions&) {
    return bvh;
}

}  // namespace bvhio
