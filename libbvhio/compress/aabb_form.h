// The aabb form: the canonical tree itself, 32-byte nodes with full-precision boxes.
#pragma once

#include <array>

#include "compress/form_concept.h"

namespace bvhio {

class AabbForm {
  public:
    static constexpr std::string_view kName = "aabb";
    static constexpr std::string_view kSummary = "32-byte nodes with full-precision boxes";
    static constexpr FormTraits kTraits{.isExact = true, .keepsOrder = true};
    static constexpr std::array<std::string_view, 1> kCandidates{""};
    struct Options {
        bool operator==(const Options&) const = default;
    };
    static std::span<const FormOption<Options>> optionTable() { return {}; }

    explicit AabbForm(Bvh bvh) : bvh_(std::move(bvh)) {}
    static AabbForm encode(const Scene&, const Bvh& bvh, const Options&) { return AabbForm(bvh); }

    Bvh decode() const { return bvh_; }
    const Bvh& bvh() const { return bvh_; }
    std::span<const uint32_t> primitives() const { return bvh_.primitives; }
    Options options() const { return {}; }
    size_t nodeBytes() const { return bvh_.nodes.size() * sizeof(Node); }

  private:
    Bvh bvh_;
};
static_assert(Form<AabbForm>);

}  // namespace bvhio
