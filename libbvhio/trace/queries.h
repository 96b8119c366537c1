// What is asked of a ray: its closest hit, or whether it hits anything.
#pragma once

#include "core/intersect.h"

namespace bvhio {

/// The closest hit; among equal t the lowest primitive index.
class ClosestHit {
  public:
    explicit ClosestHit(const PreparedRay& ray) : boxLimit_(widen(ray.tMax)) { best_.t = ray.tMax; }

    /// Hits beyond this t are of no interest, hits at it are.
    BVHIO_INLINE float tLimit() const { return best_.t; }
    /// Boxes beyond this t are of no interest.
    BVHIO_INLINE float boxLimit() const { return boxLimit_; }
    /// Takes a hit with t <= tLimit(); true when the query is done.
    BVHIO_INLINE bool offer(const Hit& hit) {
        if (hit.t < best_.t || hit.primitive < best_.primitive) {
            best_ = hit;
            boxLimit_ = widen(hit.t);
        }
        return false;
    }
    Hit result() const { return best_.isMiss() ? Hit{} : best_; }

  private:
    Hit best_;
    float boxLimit_;
};

/// Whether there is any hit.
class AnyHit {
  public:
    explicit AnyHit(const PreparedRay& ray) : tLimit_(ray.tMax), boxLimit_(widen(ray.tMax)) {}

    BVHIO_INLINE float tLimit() const { return tLimit_; }
    BVHIO_INLINE float boxLimit() const { return boxLimit_; }
    BVHIO_INLINE bool offer(const Hit&) { return found_ = true; }
    bool result() const { return found_; }

  private:
    float tLimit_, boxLimit_;
    bool found_ = false;
};

}  // namespace bvhio
