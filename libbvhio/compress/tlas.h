// The top level of the two-level form: a tree in one of the other forms, in whose leaves BLASes are entered.
//
// A TLAS is stepped through like a form. Beyond that, `entry` says of a leaf that was entered what the root
// of a BLAS takes over: BoxEntry, or something that answers the same questions.
#pragma once

#include "compress/aabb_form.h"

namespace bvhio {

/// A ray that enters a box: for a leaf of the top level whose box is at hand.
struct BoxEntry {
    const PreparedRay& ray;
    const Aabb& box;
    float enter, tLimit;

    /// Where the ray leaves the box.
    BVHIO_INLINE float exit() const { return clipToBox(ray, box, tLimit).exit; }
};

/// The aabb form as a top level. Its cursor remembers the node, since BLASes ask for its box.
class AabbTlas {
  public:
    using Form = AabbForm;
    using Ray = AabbForm::Ray;
    const PreparedRay& prepare(const PreparedRay& ray) const { return ray; }
    static constexpr int kMaxChildren = AabbForm::kMaxChildren;

    struct Cursor {
        uint32_t first, primitiveCount, node;

        BVHIO_INLINE void set(const Node& from, uint32_t index) {
            first = from.first;
            primitiveCount = from.primitiveCount;
            node = index;
        }
    };

    explicit AabbTlas(AabbForm form) : form_(std::move(form)) {}
    const AabbForm& form() const { return form_; }

    template <class Metrics>
    BVHIO_INLINE bool enterRoot(const PreparedRay& ray, float tLimit, Entered<Cursor>& root,
                                Metrics& metrics) const {
        Entered<AabbForm::Cursor> entered;
        const bool hit = form_.enterRoot(ray, tLimit, entered, metrics);
        root = {{entered.cursor.first, entered.cursor.primitiveCount, 0}, entered.enter};
        return hit;
    }

    template <class Metrics>
    BVHIO_INLINE int step(const Entered<Cursor>& from, const PreparedRay& ray, float tLimit,
                          Entered<Cursor>* children, Metrics& metrics) const {
        return form_.stepToPair(from.cursor.first, ray, tLimit, children, metrics);
    }

    bool isLeaf(const Cursor& cursor) const { return cursor.primitiveCount != 0; }
    PrimitiveRange primitiveRange(const Cursor& cursor) const {
        return {cursor.first, cursor.primitiveCount};
    }

    BVHIO_INLINE BoxEntry entry(const Entered<Cursor>& leaf, const PreparedRay& ray, float tLimit) const {
        return {ray, form_.bvh().nodes[leaf.cursor.node].bounds, leaf.enter, tLimit};
    }

  private:
    AabbForm form_;
};
static_assert(SteppableForm<AabbTlas>);

}  // namespace bvhio
