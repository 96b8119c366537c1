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

/// A query as seen from within an instance whose box the ray enters at `enter`: takes those hits that the
/// definition in scene/instance.h allows, triangles' indices turned into the instance's primitives.
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
