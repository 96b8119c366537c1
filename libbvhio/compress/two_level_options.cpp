// The table of the two-level form's options.
#include "compress/two_level_form.h"

namespace bvhio {
namespace {

/// Returns the names of a level's forms.
template <class... Levels>
constexpr std::array<NamedValue, sizeof...(Levels)> namedLevels(const std::variant<Levels...>*) {
    return {NamedValue{Levels::kName, Levels::kSummary}...};
}
constexpr auto kTlasForms = namedLevels(static_cast<const TwoLevelForm::Tlas*>(nullptr));
constexpr auto kBlasForms = namedLevels(static_cast<const TwoLevelForm::Blases*>(nullptr));

}  // namespace

std::span<const FormOption<TwoLevelForm::Options>> TwoLevelForm::optionTable() {
    static constexpr FormOption<Options> kTable[] = {
        memberOption<&Options::tlasForm>({.name = "--tlas-form",
                                          .help = "form of the top level",
                                          .kind = OptionKind::choice,
                                          .values = kTlasForms}),
        memberOption<&Options::blasForm>({.name = "--blas-form",
                                          .help = "form of the BLASes",
                                          .kind = OptionKind::choice,
                                          .values = kBlasForms}),
        memberOption<&Options::blasSize>({.name = "--blas-size",
                                          .help = "most references per BLAS, where leaves allow it",
                                          .min = 1,
                                          .max = kMaxLeafSize}),
        memberOption<&Options::bits>({.name = "--bits",
                                      .min = QuantizedRecord::kMinBits,
                                      .max = QuantizedRecord::kMaxBits,
                                      .part = "quantized levels"},
                                     [](const Options& options) {
                                         return options.tlasForm == TlasForm::quantized ||
                                                options.blasForm == BlasForm::quantized;
                                     }),
        memberOption<&Options::blasLeafSize>(
            {.name = "--leaf-size", .min = 1, .max = NibbleRuns::kMaxLeafSize, .part = "mvh BLASes"},
            [](const Options& options) { return options.blasForm == BlasForm::mvh; })};
    return kTable;
}

}  // namespace bvhio
