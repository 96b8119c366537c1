// The options of the mvh form, as command lines have them.
#include <algorithm>
#include <charconv>
#include <string>

#include "compress/mvh_form.h"
#include "core/error.h"

namespace bvhio {
namespace {

using Options = MvhForm::Options;

constexpr NamedValue kMvhBuilds[] = {
    {"best", "the best of three axes and three orders at each node"},
    {"paper", "along the longest axis, with one zeta for all cuts"},
};

/// Options that encode an MVH again, as it is, say nothing of how a new one is to be built: they keep its
/// leaves alone.
void startAnew(Options& options) {
    if (options.build == MvhBuild::given) options = {.leafSize = options.leafSize};
}
bool isBuiltAnew(const Options& options) {
    return options.build != MvhBuild::given;
}

float zetaNumber(const std::string& zeta, const std::string& text, float max) {
    float value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value >= 0.01f && value <= max))
        throw Error(ErrorKind::usage, "--zeta: '" + zeta +
                                          "' is neither auto nor a number from 0.01 to 0.99, with a "
                                          "second one up to 0.5 behind a comma");
    return value;
}

void setZeta(Options& options, const OptionValue& value) {
    startAnew(options);
    const std::string& zeta = value.text;
    options.zeta = options.zetaOfBoth = 0;
    if (zeta == "auto") return;
    const size_t comma = std::min(zeta.find(','), zeta.size());
    options.zeta = zetaNumber(zeta, zeta.substr(0, comma), MvhRule::kMaxZeta);
    if (comma < zeta.size())
        options.zetaOfBoth = zetaNumber(zeta, zeta.substr(comma + 1), MvhRule::kMaxZetaOfBoth);
}

OptionValue zetaOf(const Options& options) {
    if (options.zeta == 0) return {.text = "auto"};
    const auto text = [](float zeta) {
        char digits[32];
        return std::string(digits, std::to_chars(digits, digits + sizeof digits, zeta).ptr);
    };
    OptionValue value{.text = text(options.zeta)};
    if (options.zetaOfBoth > 0) value.text.append(",").append(text(options.zetaOfBoth));
    return value;
}

}  // namespace

std::span<const FormOption<Options>> MvhForm::optionTable() {
    static constexpr FormOption<Options> kTable[] = {
        {{.name = "--mvh-build",
          .help = "how triangles are divided",
          .kind = OptionKind::choice,
          .values = kMvhBuilds,
          .place = 1},
         [](Options& options, const OptionValue& value) {
             startAnew(options);
             options.build = MvhBuild(value.number);
         },
         [](const Options& options) { return OptionValue{uint32_t(options.build)}; },
         isBuiltAnew},
        {{.name = "--leaf-size",
          .help = "triangles per leaf",
          .min = 1,
          .max = MvhParameters::kMaxLeafSize,
          .place = 1},
         [](Options& options, const OptionValue& value) {
             startAnew(options);
             options.leafSize = value.number;
         },
         [](const Options& options) { return OptionValue{options.leafSize}; },
         isBuiltAnew},
        {{.name = "--zeta",
          .help = "part of a box that a cut of one plane takes off, and a cut of both",
          .kind = OptionKind::text,
          .valueName = "auto|ONE[,BOTH]",
          .place = 1},
         setZeta,
         zetaOf,
         isBuiltAnew},
        {{.name = "--cut-axes",
          .help = "axes that take turns where a node cannot be cut; 0: as suits the tree",
          .max = 3,
          .isEveryday = false,
          .place = 1},
         [](Options& options, const OptionValue& value) {
             startAnew(options);
             options.cutAxes = value.number;
         },
         [](const Options& options) { return OptionValue{options.cutAxes}; },
         isBuiltAnew}};
    return kTable;
}

}  // namespace bvhio
