// The top level of the two-level form: a tree in one of the other forms, in whose leaves BLASes are entered.
//
// A TLAS is stepped through like a form. Beyond that, `entry` says of a leaf that was entered what the root
// of a BLAS takes over: BoxEntry, or something that answers the same questions.
#pragma once

#include <vector>

#include "compress/aabb_form.h"
#include "compress/quantized_form.h"
#include "compress/root_places.h"

namespace bvhio {

/// A top level as a tree, and its boxes as insets, too, by node.
struct DecodedTlas {
    Bvh bvh;
    std::vector<InsetBox> insets;

    /// Where the trees below the leaves have their roots: by the index that a leaf has as its first entry;
    /// or, where leaves have the runs that their trees are over, one after the other. Then `bvh` is changed
    /// so that its leaves have these indices.
    RootPlaces places(bool areRuns);
};

/// A ray that enters a box: for a leaf of the top level whose box is at hand.
struct BoxEntry {
    const PreparedRay& ray;
    const Aabb& box;
    float enter, tLimit;

    /// Where the ray leaves the box.
    BVHIO_INLINE float exit() const { return clipToBox(ray, box, tLimit).exit; }
    /// The box as the ray sees it in the frame of the top level's root.
    BVHIO_INLINE PlacedBox place(const RayFrame& frame) const { return frame.place(box); }
};

/// The same for a leaf whose box is placed already.
struct PlacedEntry {
    const RayFrame& ray;
    const PlacedBox& box;
    float enter, tLimit;

    BVHIO_INLINE float exit() const { return ray.clip(box, tLimit).exit; }
    BVHIO_INLINE PlacedBox place(const RayFrame&) const { return box; }
};

/// The aabb form as a top level. Its cursor remembers the node, since BLASes ask for its box.
class AabbTlas {
  public:
    using Form = AabbForm;
    static constexpr std::string_view kName = Form::kName;
    using Ray = AabbForm::Ray;
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
    const Aabb& bounds() const { return form_.bvh().nodes[0].bounds; }
    DecodedTlas decode() const;

    static const PreparedRay& prepare(const PreparedRay& ray) { return ray; }

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

/// The quantized form as a top level.
class QuantizedTlas {
  public:
    using Form = QuantizedForm;
    static constexpr std::string_view kName = Form::kName;
    using Cursor = QuantizedForm::Cursor;
    using Ray = QuantizedForm::Ray;
    static constexpr int kMaxChildren = QuantizedForm::kMaxChildren;

    explicit QuantizedTlas(QuantizedForm form) : form_(std::move(form)) {}
    const QuantizedForm& form() const { return form_; }
    const Aabb& bounds() const { return form_.bounds(); }
    DecodedTlas decode() const;

    RayFrame prepare(const PreparedRay& ray) const { return form_.prepare(ray); }

    template <class Metrics>
    BVHIO_INLINE bool enterRoot(const RayFrame& ray, float tLimit, Entered<Cursor>& root,
                                Metrics& metrics) const {
        return form_.enterRoot(ray, tLimit, root, metrics);
    }
    template <class Metrics>
    BVHIO_INLINE int step(const Entered<Cursor>& from, const RayFrame& ray, float tLimit,
                          Entered<Cursor>* children, Metrics& metrics) const {
        return form_.step(from, ray, tLimit, children, metrics);
    }
    bool isLeaf(const Cursor& cursor) const { return form_.isLeaf(cursor); }
    PrimitiveRange primitiveRange(const Cursor& cursor) const { return form_.primitiveRange(cursor); }

    BVHIO_INLINE PlacedEntry entry(const Entered<Cursor>& leaf, const RayFrame& ray, float tLimit) const {
        return {ray, leaf.cursor.box, leaf.enter, tLimit};
    }

  private:
    QuantizedForm form_;
};
static_assert(SteppableForm<QuantizedTlas>);

}  // namespace bvhio
