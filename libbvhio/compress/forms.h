// The list of forms. A new form takes its own file and one line here.
#pragma once

#include <array>
#include <string>
#include <type_traits>
#include <variant>

#include "compress/aabb_form.h"
#include "compress/mvh_form.h"
#include "compress/quantized_form.h"
#include "compress/quantized_short_form.h"
#include "compress/ssh_form.h"
#include "compress/two_level_form.h"
#include "core/choice.h"
#include "core/error.h"

namespace bvhio {

using EncodedBvh = std::variant<AabbForm, QuantizedForm, QuantizedShortForm, SshForm, MvhForm, TwoLevelForm>;

namespace detail {
template <class>
struct OptionsOfForms;
template <class... Forms>
struct OptionsOfForms<std::variant<Forms...>> {
    using Type = std::variant<std::monostate, typename Forms::Options...>;
};
}  // namespace detail

/// Options of one of the forms. Without a form, they stand for the defaults of any form.
using EncodeOptions = detail::OptionsOfForms<EncodedBvh>::Type;

/// Returns the options of a form. Throws Error{usage} if they are another form's.
template <class Form>
typename Form::Options optionsFor(const EncodeOptions& options) {
    if (std::holds_alternative<std::monostate>(options)) return {};
    if (const auto* own = std::get_if<typename Form::Options>(&options)) return *own;
    throw Error(ErrorKind::usage, "the options are not for form " + std::string(Form::kName));
}

/// The encoder of a form, and what the form does to a tree.
struct FormMethod {
    EncodedBvh (*encode)(const Scene&, const Bvh&, const EncodeOptions&);
    FormTraits traits;

    EncodedBvh operator()(const Scene& scene, const Bvh& bvh, const EncodeOptions& options) const {
        return encode(scene, bvh, options);
    }
};
/// A row of the table that the variant makes: a form's name, its summary and its encoder.
using FormChoice = Choice<FormMethod>;

namespace detail {
template <class... Forms>
constexpr std::array<FormChoice, sizeof...(Forms)> formTable(const std::variant<Forms...>*) {
    return {FormChoice{Forms::kName, Forms::kSummary,
                       FormMethod{[](const Scene& scene, const Bvh& bvh, const EncodeOptions& options) {
                                      return EncodedBvh(
                                          Forms::encode(scene, bvh, optionsFor<Forms>(options)));
                                  },
                                  Forms::kTraits}}...};
}
}  // namespace detail

/// Returns all forms, the default first.
inline std::span<const FormChoice> forms() {
    static constexpr auto kTable = detail::formTable(static_cast<const EncodedBvh*>(nullptr));
    return kTable;
}

/// Calls function(std::type_identity<F>()) for the form called `name`. Throws Error{usage} with a list of all
/// names if there is no such form.
template <size_t I = 0, class Function>
auto visitForm(std::string_view name, const Function& function) {
    using F = std::variant_alternative_t<I, EncodedBvh>;
    if constexpr (I == 0) choose(forms(), "form", name);
    if constexpr (I + 1 < std::variant_size_v<EncodedBvh>)
        if (name != F::kName) return visitForm<I + 1>(name, function);
    return function(std::type_identity<F>());
}

/// Returns the name of the form that stores the tree.
inline std::string_view formNameOf(const EncodedBvh& bvh) {
    return std::visit([](const auto& form) { return form.kName; }, bvh);
}

/// Returns what that form does to a tree.
inline FormTraits traitsOf(const EncodedBvh& bvh) {
    return std::visit([](const auto& form) { return form.kTraits; }, bvh);
}

/// Returns the options that encode another tree in the same way.
inline EncodeOptions optionsOf(const EncodedBvh& bvh) {
    return std::visit([](const auto& form) { return EncodeOptions(form.options()); }, bvh);
}

/// Returns the tree itself if the form stores it unchanged, otherwise null.
inline const Bvh* canonicalTree(const EncodedBvh& bvh) {
    const auto* aabb = std::get_if<AabbForm>(&bvh);
    return aabb != nullptr ? &aabb->bvh() : nullptr;
}

/// Returns whether this is a tree over the instances of a scene, with trees over its meshes. Such trees are
/// in the two-level form.
inline bool isInstanced(const EncodedBvh& bvh) {
    const auto* levels = std::get_if<TwoLevelForm>(&bvh);
    return levels && levels->isInstanced();
}

/// Returns the canonical tree, with boxes as the form reconstructs them.
inline Bvh decode(const EncodedBvh& bvh) {
    return std::visit([](const auto& form) { return form.decode(); }, bvh);
}

}  // namespace bvhio
