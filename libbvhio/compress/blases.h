// The bottom level of the two-level form: many trees of one form, whose nodes share one array.
//
// A root holds only what a ray needs to continue from there: 4 or 8 bytes in an array of their own. Its box
// is that of the top level's leaf. (The roots of compress/nibble_blases.h need no bytes at all.)
#pragma once

#include "compress/aabb_form.h"
#include "compress/forest.h"
#include "compress/nibble_blases.h"
#include "compress/quantized_form.h"
#include "compress/ssh_form.h"

namespace bvhio {

/// BLASes in a form whose nodes refer to their children. Links has the details of the form:
/// - Form, and Root: an element of the array of roots,
/// - kMaxLeafSize: the limit of the form,
/// - encode, decode: as below.
template <class Links>
class LinkedBlases {
  public:
    using Form = typename Links::Form;
    using Root = typename Links::Root;
    static constexpr std::string_view kName = Form::kName, kSummary = Form::kSummary;
    static constexpr bool kAreRuns = false;
    static constexpr uint32_t kMaxLeafSize = Links::kMaxLeafSize;

    /// `form` has only nodes: those below the roots of all trees.
    LinkedBlases(SharedArray<Root> roots, Form form) : roots_(std::move(roots)), form_(std::move(form)) {}

    /// Of trees that have the boxes of `places` at their roots. Throws Error{unsupported} where the form
    /// does.
    static LinkedBlases encode(const Forest& forest, const RootPlaces& places, size_t references,
                               const typename Form::Options& options) {
        return Links::encode(forest, places, references, options);
    }
    Forest decode(const RootPlaces& places) const { return Links::decode(*this, places); }

    const SharedArray<Root>& roots() const { return roots_; }
    const Form& form() const { return form_; }
    /// Returns the bytes of the nodes and the roots.
    size_t nodeBytes() const { return form_.nodeBytes() + roots_.size() * sizeof(Root); }

  private:
    SharedArray<Root> roots_;
    Form form_;
};

/// A root: the fields of a Node without its box.
struct AabbRoot {
    uint32_t first, primitiveCount;
};

struct AabbLinks {
    using Form = AabbForm;
    using Root = AabbRoot;
    static constexpr uint32_t kMaxLeafSize = bvhio::kMaxLeafSize;

    static LinkedBlases<AabbLinks> encode(const Forest& forest, const RootPlaces& places, size_t references,
                                          const AabbForm::Options& options);
    static Forest decode(const LinkedBlases<AabbLinks>& blases, const RootPlaces& places);
};

struct SshLinks {
    using Form = SshForm;
    using Root = uint32_t;  // the word of a node; its plane is not needed
    static constexpr uint32_t kMaxLeafSize = SshNode::kMaxLeafSize;

    static LinkedBlases<SshLinks> encode(const Forest& forest, const RootPlaces& places, size_t references,
                                         const SshForm::Options& options);
    static Forest decode(const LinkedBlases<SshLinks>& blases, const RootPlaces& places);
};

/// BLASes in the quantized form, with boxes relative to the root's box.
struct QuantizedLinks {
    using Form = QuantizedForm;
    using Root = QuantizedRoot;
    static constexpr uint32_t kMaxLeafSize = QuantizedRecord::kMaxLeafSize;

    static LinkedBlases<QuantizedLinks> encode(const Forest& forest, const RootPlaces& places,
                                               size_t references, const QuantizedForm::Options& options);
    static Forest decode(const LinkedBlases<QuantizedLinks>& blases, const RootPlaces& places);
};

using AabbBlases = LinkedBlases<AabbLinks>;
using SshBlases = LinkedBlases<SshLinks>;
using QuantizedBlases = LinkedBlases<QuantizedLinks>;

}  // namespace bvhio
