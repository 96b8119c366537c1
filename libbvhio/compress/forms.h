// THE list of forms. A new form is its own file and one line here.
#pragma once

#include <array>
#include <variant>

#include "compress/aabb_form.h"
#include "compress/mvh_form.h"
#include "compress/quantized_form.h"
#include "compress/quantized_short_form.h"
#include "compress/ssh_form.h"
#include "compress/two_level_form.h"
#include "core/choice.h"

namespace bvhio {

using EncodedBvh = std::variant<AabbForm, QuantizedForm, QuantizedShortForm, SshForm, MvhForm, TwoLevelForm>;

/// A row of the table that the variant makes: a form's name, its summary and its encoder.
using FormChoice = Choice<EncodedBvh (*)(const Scene&, const Bvh&, const EncodeOptions&)>;

namespace detail {
template <class... Forms>
constexpr std::array<FormChoice, sizeof...(Forms)> formTable(const std::variant<Forms...>*) {
    return {FormChoice{Forms::kName, Forms::kSummary,
                       [](const Scene& scene, const Bvh& bvh, const EncodeOptions& options) {
                           return EncodedBvh(Forms::encode(scene, bvh, options));
                       }}...};
}
}  // namespace detail

/// All forms, the default first.
inline std::span<const FormChoice> forms() {
    static constexpr auto kTable = detail::formTable(static_cast<const EncodedBvh*>(nullptr));
    return kTable;
}

/// The name of the form that holds the tree.
inline std::string_view formNameOf(const EncodedBvh& bvh) {
    return std::visit([](const auto& form) { return form.kName; }, bvh);
}

/// What encodes another tree alike.
inline EncodeOptions optionsOf(const EncodedBvh& bvh) {
    return std::visit([](const auto& form) { return form.options(); }, bvh);
}

/// Whether the tree is over the instances of a scene, and trees over its meshes: then it is in the two-level
/// form.
inline bool isInstanced(const EncodedBvh& bvh) {
    const auto* levels = std::get_if<TwoLevelForm>(&bvh);
    return levels && levels->isInstanced();
}

/// The canonical tree, boxes as the form reconstructs them.
inline Bvh decode(const EncodedBvh& bvh) {
    return std::visit([](const auto& form) { return form.decode(); }, bvh);
}

}  // namespace bvhio
