// The bottom level of the two-level form: many trees of one form, whose nodes share one array.
//
// BLASes are stepped through like a form, from `root`: the root of the BLAS that a leaf of the top level
// names, given how the ray enters that leaf's box, which is the root's box too. Roots have nothing but what
// tells where to go on: 4 or 8 bytes in an array of their own.
#pragma once

#include "compress/aabb_form.h"
#include "compress/mvh_blases.h"
#include "compress/ssh_form.h"
#include "compress/two_levels.h"

namespace bvhio {

/// BLASes in the aabb form.
class AabbBlases {
  public:
    static constexpr std::string_view kName = AabbForm::kName;
    static constexpr bool kAreRuns = false;
    using Cursor = AabbForm::Cursor;
    using Ray = AabbForm::Ray;
    using Root = AabbForm::Cursor;
    static constexpr int kMaxChildren = AabbForm::kMaxChildren;

    AabbBlases(SharedArray<Root> roots, SharedArray<Node> nodes)
        : roots_(std::move(roots)), form_({std::move(nodes), {}}) {}
    static AabbBlases encode(const Forest& forest, size_t references);
    Forest decode(std::span<const Aabb> boxes) const;

    const SharedArray<Root>& roots() const { return roots_; }
    const SharedArray<Node>& nodes() const { return form_.bvh().nodes; }
    /// The nodes, then the roots.
    size_t nodeBytes() const { return form_.nodeBytes() + roots_.size() * sizeof(Root); }

    static const PreparedRay& prepare(const PreparedRay& ray, const Aabb&) { return ray; }

    /// `leaf` and `entry` are those of a leaf of the top level.
    template <class Entry, class Metrics>
    BVHIO_INLINE Entered<Cursor> root(PrimitiveRange leaf, const Entry& entry, Ray, Metrics& metrics) const {
        metrics.recordFetched(form_.nodeBytes() + leaf.first * sizeof(Root), sizeof(Root));
        return {roots_[leaf.first], entry.enter};
    }

    template <class Metrics>
    BVHIO_INLINE int step(const Entered<Cursor>& from, const PreparedRay& ray, float tLimit,
                          Entered<Cursor>* children, Metrics& metrics) const {
        return form_.step(from, ray, tLimit, children, metrics);
    }
    bool isLeaf(const Cursor& cursor) const { return form_.isLeaf(cursor); }
    PrimitiveRange primitiveRange(const Cursor& cursor) const { return form_.primitiveRange(cursor); }

  private:
    SharedArray<Root> roots_;
    AabbForm form_;
};
static_assert(SteppableForm<AabbBlases>);

/// BLASes in the ssh form.
class SshBlases {
  public:
    static constexpr std::string_view kName = SshForm::kName;
    static constexpr bool kAreRuns = false;
    using Cursor = SshForm::Cursor;
    using Ray = SshForm::Ray;
    using Root = uint32_t;  // the word of a node whose plane says nothing
    static constexpr int kMaxChildren = SshForm::kMaxChildren;

    SshBlases(SharedArray<Root> roots, SharedArray<SshNode> nodes)
        : roots_(std::move(roots)), form_({}, std::move(nodes), {}) {}
    static SshBlases encode(const Forest& forest, size_t references);
    Forest decode(std::span<const Aabb> boxes) const;

    const SharedArray<Root>& roots() const { return roots_; }
    const SharedArray<SshNode>& nodes() const { return form_.nodes(); }
    /// The nodes, then the roots.
    size_t nodeBytes() const { return form_.nodeBytes() + roots_.size() * sizeof(Root); }

    static SshRay prepare(const PreparedRay& ray, const Aabb&) { return SshRay(ray); }

    template <class Entry, class Metrics>
    BVHIO_INLINE Entered<Cursor> root(PrimitiveRange leaf, const Entry& entry, const Ray&,
                                      Metrics& metrics) const {
        metrics.recordFetched(form_.nodeBytes() + leaf.first * sizeof(Root), sizeof(Root));
        return {{roots_[leaf.first], entry.exit()}, entry.enter};
    }

    template <class Metrics>
    BVHIO_INLINE int step(const Entered<Cursor>& from, const SshRay& ray, float tLimit,
                          Entered<Cursor>* children, Metrics& metrics) const {
        return form_.step(from, ray, tLimit, children, metrics);
    }
    bool isLeaf(const Cursor& cursor) const { return form_.isLeaf(cursor); }
    PrimitiveRange primitiveRange(const Cursor& cursor) const { return form_.primitiveRange(cursor); }

  private:
    SharedArray<Root> roots_;
    SshForm form_;
};
static_assert(SteppableForm<SshBlases>);

}  // namespace bvhio
