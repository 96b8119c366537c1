// The bottom level of the two-level form: many trees of one form, whose nodes share one array.
//
// The BLAS that a leaf of the top level names, `tree`, is stepped through like a form, from its `root`, given
// how the ray enters that leaf's box, which is the root's box too. Roots have nothing but what tells where to
// go on: 4 or 8 bytes in an array of their own. (Those of compress/mvh_blases.h have not even that.)
#pragma once

#include "compress/aabb_form.h"
#include "compress/mvh_blases.h"
#include "compress/quantized_form.h"
#include "compress/ssh_form.h"
#include "compress/two_levels.h"

namespace bvhio {

template <class Links>
class LinkedTree;

/// BLASes in a form whose nodes name their children. Links says what is special to the form:
/// - Form, Root: an element of the array of roots,
/// - kMaxLeafSize: of the form,
/// - prepare(ray, bounds): the form's Ray; `bounds` are those of the top level's root, or of a mesh,
/// - cursor(root, entry, ray): that of a root, as the box is entered,
/// - encode, decode: as below.
template <class Links>
class LinkedBlases {
  public:
    using Form = typename Links::Form;
    using Root = typename Links::Root;
    using Ray = typename Form::Ray;
    static constexpr std::string_view kName = Form::kName;
    static constexpr bool kAreRuns = false;
    static constexpr uint32_t kMaxLeafSize = Links::kMaxLeafSize;

    /// `form` has nodes only: those below all roots.
    LinkedBlases(SharedArray<Root> roots, Form form) : roots_(std::move(roots)), form_(std::move(form)) {}

    /// Of trees that have the boxes of `places` at their roots. Throws Error{unsupported} where the form
    /// does.
    static LinkedBlases encode(const Forest& forest, const RootPlaces& places, size_t references,
                               const EncodeOptions& options) {
        return Links::encode(forest, places, references, options);
    }
    Forest decode(const RootPlaces& places) const { return Links::decode(*this, places); }

    const SharedArray<Root>& roots() const { return roots_; }
    const Form& form() const { return form_; }
    /// The nodes, then the roots.
    size_t nodeBytes() const { return form_.nodeBytes() + roots_.size() * sizeof(Root); }

    static decltype(auto) prepare(const PreparedRay& ray, const Aabb& bounds) {
        return Links::prepare(ray, bounds);
    }

    /// The one that a leaf of the top level names.
    BVHIO_INLINE LinkedTree<Links> tree(PrimitiveRange leaf) const { return {*this, leaf.first}; }

  private:
    SharedArray<Root> roots_;
    Form form_;
};

/// One of them, for a ray to step through.
template <class Links>
class LinkedTree {
  public:
    using Form = typename Links::Form;
    using Cursor = typename Form::Cursor;
    using Ray = typename Form::Ray;
    static constexpr int kMaxChildren = Form::kMaxChildren;

    BVHIO_INLINE LinkedTree(const LinkedBlases<Links>& blases, uint32_t number)
        : blases_(blases), number_(number) {}

    /// `entry` is that of the leaf of the top level.
    template <class Entry, class Metrics>
    BVHIO_INLINE Entered<Cursor> root(const Entry& entry, const Ray& ray, Metrics& metrics) const {
        using Root = typename Links::Root;
        metrics.recordFetched(form().nodeBytes() + number_ * sizeof(Root), sizeof(Root));
        return {Links::cursor(blases_.roots()[number_], entry, ray), entry.enter};
    }

    template <class Metrics>
    BVHIO_INLINE int step(const Entered<Cursor>& from, const Ray& ray, float tLimit,
                          Entered<Cursor>* children, Metrics& metrics) const {
        return form().step(from, ray, tLimit, children, metrics);
    }
    bool isLeaf(const Cursor& cursor) const { return form().isLeaf(cursor); }
    PrimitiveRange primitiveRange(const Cursor& cursor) const { return form().primitiveRange(cursor); }

  private:
    BVHIO_INLINE const Form& form() const { return blases_.form(); }

    const LinkedBlases<Links>& blases_;
    uint32_t number_;
};

struct AabbLinks {
    using Form = AabbForm;
    using Root = AabbForm::Cursor;
    static constexpr uint32_t kMaxLeafSize = bvhio::kMaxLeafSize;

    static LinkedBlases<AabbLinks> encode(const Forest& forest, const RootPlaces& places, size_t references,
                                          const EncodeOptions& options);
    static Forest decode(const LinkedBlases<AabbLinks>& blases, const RootPlaces& places);
    static const PreparedRay& prepare(const PreparedRay& ray, const Aabb&) { return ray; }
    template <class Entry>
    static BVHIO_INLINE Form::Cursor cursor(const Root& root, const Entry&, const PreparedRay&) {
        return root;
    }
};

struct SshLinks {
    using Form = SshForm;
    using Root = uint32_t;  // the word of a node whose plane says nothing
    static constexpr uint32_t kMaxLeafSize = SshNode::kMaxLeafSize;

    static LinkedBlases<SshLinks> encode(const Forest& forest, const RootPlaces& places, size_t references,
                                         const EncodeOptions& options);
    static Forest decode(const LinkedBlases<SshLinks>& blases, const RootPlaces& places);
    static SshRay prepare(const PreparedRay& ray, const Aabb&) { return SshRay(ray); }
    template <class Entry>
    static BVHIO_INLINE Form::Cursor cursor(Root root, const Entry& entry, const SshRay&) {
        return {root, entry.exit()};
    }
};

/// Boxes are relative to the root's: a ray takes over its place from the leaf above.
struct QuantizedLinks {
    using Form = QuantizedForm;
    using Root = QuantizedRoot;
    static constexpr uint32_t kMaxLeafSize = QuantizedRecord::kMaxLeafSize;

    static LinkedBlases<QuantizedLinks> encode(const Forest& forest, const RootPlaces& places,
                                               size_t references, const EncodeOptions& options);
    static Forest decode(const LinkedBlases<QuantizedLinks>& blases, const RootPlaces& places);
    static RayFrame prepare(const PreparedRay& ray, const Aabb& bounds) { return {ray, bounds}; }
    template <class Entry>
    static BVHIO_INLINE Form::Cursor cursor(const Root& root, const Entry& entry, const RayFrame& ray) {
        return {entry.place(ray), root.word, uint8_t(root.more)};
    }
};

using AabbBlases = LinkedBlases<AabbLinks>;
using SshBlases = LinkedBlases<SshLinks>;
using QuantizedBlases = LinkedBlases<QuantizedLinks>;
static_assert(SteppableForm<LinkedTree<AabbLinks>> && SteppableForm<LinkedTree<SshLinks>> &&
              SteppableForm<LinkedTree<QuantizedLinks>>);

}  // namespace bvhio
