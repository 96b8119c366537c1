// Queries for rays: the closest hit, or any hit.
#pragma once

#include "core/intersect.h"

namespace bvhio {

/// Finds the closest hit; among equal t, the one with the lowest primitive index.
class ClosestHitQuery {
  public:
    explicit ClosestHitQuery(const PreparedRay& ray) : boxLimit_(widen(ray.tMax)) { best_.t = ray.tMax; }

    /// Returns the largest t at which hits matter.
    BVHIO_INLINE float tLimit() const { return best_.t; }
    /// Returns the largest t at which boxes matter.
    BVHIO_INLINE float boxLimit() const { return boxLimit_; }
    /// Takes a hit with t <= tLimit(). Returns whether the query is done.
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

/// A query inside an instance, whose box the ray enters at `enter`. It takes only hits that the definition in
/// scene/instance.h allows, and turns indices of triangles into the instance's primitives.
template <class Query>
class InstanceQuery {
  public:
    InstanceQuery(Query& query, float enter, uint32_t primitiveOffset)
        : query_(query), enter_(enter), primitiveOffset_(primitiveOffset) {}

    BVHIO_INLINE float tLimit() const { return query_.tLimit(); }
    BVHIO_INLINE float boxLimit() const { return query_.boxLimit(); }
    BVHIO_INLINE bool offer(Hit hit) {
        hit.primitive += primitiveOffset_;
        return enter_ <= widen(hit.t) && query_.offer(hit);
    }

  private:
    Query& query_;
    float enter_;
    uint32_t primitiveOffset_;
};

/// Finds out whether there is any hit.
class AnyHitQuery {
  public:
    explicit AnyHitQuery(const PreparedRay& ray) : tLimit_(ray.tMax), boxLimit_(widen(ray.tMax)) {}

    BVHIO_INLINE float tLimit() const { return tLimit_; }
    BVHIO_INLINE float boxLimit() const { return boxLimit_; }
    BVHIO_INLINE bool offer(const Hit&) { return found_ = true; }
    bool result() const { return found_; }

  private:
    float tLimit_, boxLimit_;
    bool found_ = false;
};

}  // namespace bvhio
