// The aabb form: the canonical tree itself, 32-byte nodes with full-precision boxes.
#pragma once

#include "compress/form_concept.h"

namespace bvhio {

class AabbForm {
  public:
    static constexpr std::string_view kName = "aabb";
    static constexpr std::string_view kSummary = "32-byte nodes with full-precision boxes";

    explicit AabbForm(Bvh bvh) : bvh_(std::move(bvh)) {}
    static AabbForm encode(const Scene&, const Bvh& bvh, const EncodeOptions&) { return AabbForm(bvh); }

    Bvh decode() const { return bvh_; }
    const Bvh& bvh() const { return bvh_; }
    std::span<const uint32_t> primitives() const { return bvh_.primitives; }
    EncodeOptions options() const { return {}; }
    size_t nodeBytes() const { return bvh_.nodes.size() * sizeof(Node); }

  private:
    Bvh bvh_;
};
static_assert(Form<AabbForm>);

}  // namespace bvhio
