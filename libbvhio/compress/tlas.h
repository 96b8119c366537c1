// The top level of the two-level form: a tree in one of the other forms. A ray in one of its leaves enters a
// BLAS.
#pragma once

#include <vector>

#include "compress/aabb_form.h"
#include "compress/quantized_form.h"
#include "compress/root_places.h"

namespace bvhio {

/// A top level as a tree, and the boxes of its nodes as insets.
struct DecodedTlas {
    Bvh bvh;
    std::vector<InsetBox> insets;

    /// Returns the places of the roots of trees, if a leaf's first entry is the index of its tree.
    RootPlaces placesOfTrees() const;
    /// Returns the places of the roots of trees, if a leaf owns the run of primitives that its tree is over.
    /// Trees are in the order of the leaves.
    RootPlaces placesOfRuns() const;
    /// Returns the tree with leaves that refer to the trees over their runs, as for placesOfTrees.
    Bvh withRunsNumbered() const;
};

/// The aabb form as a top level.
class AabbTlas {
  public:
    using Form = AabbForm;
    static constexpr std::string_view kName = Form::kName, kSummary = Form::kSummary;

    explicit AabbTlas(AabbForm form) : form_(std::move(form)) {}
    const AabbForm& form() const { return form_; }
    const Aabb& bounds() const { return form_.bvh().nodes[0].bounds; }
    DecodedTlas decode() const;

  private:
    AabbForm form_;
};

/// The quantized form as a top level.
class QuantizedTlas {
  public:
    using Form = QuantizedForm;
    static constexpr std::string_view kName = Form::kName, kSummary = Form::kSummary;

    explicit QuantizedTlas(QuantizedForm form) : form_(std::move(form)) {}
    const QuantizedForm& form() const { return form_; }
    const Aabb& bounds() const { return form_.bounds(); }
    DecodedTlas decode() const;

  private:
    QuantizedForm form_;
};

}  // namespace bvhio
