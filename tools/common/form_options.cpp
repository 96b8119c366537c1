#include "common/form_options.h"

#include <algorithm>
#include <charconv>

#include "compress/forms.h"
#include "core/error.h"

namespace bvhio {
namespace {

const std::vector<NamedValue> kMvhBuilds = {
    {"best", "the default: the best of three axes and three orders at each node"},
    {"paper", "along the longest axis, with one zeta for all cuts"},
};

template <class LevelForm>
std::vector<NamedValue> namesOf() {
    std::vector<NamedValue> names;
    for (const std::string_view name : levelForms<LevelForm>())
        names.push_back({name, names.empty() ? "the default" : ""});
    return names;
}

template <class LevelForm>
void take(std::string_view name, LevelForm& form) {
    const auto names = levelForms<LevelForm>();
    if (!name.empty()) form = LevelForm(std::find(names.begin(), names.end(), name) - names.begin());
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

}  // namespace

FormOptions::FormOptions(CommandLine& line) : line_(line) {
    line.number("--bits", bits_, QuantizedRecord::kMinBits, QuantizedRecord::kMaxBits,
                "quantized: bits a plane");
    line.number("--record-bytes", recordBytes_, 8, 16, "quantized: bytes of two siblings' record, 8 or 16");
    line.choice("--tlas-form", tlasForm_, namesOf<TlasForm>(), "two-level: how the top level is stored");
    line.choice("--blas-form", blasForm_, namesOf<BlasForm>(), "two-level: how BLASes are stored");
    line.number("--blas-size", blasSize_, 1, kMaxLeafSize,
                "two-level: most references in a BLAS, where leaves allow it");
    line.choice("--mvh-build", mvhBuild_, kMvhBuilds, "mvh: how triangles are divided");
    line.number("--leaf-size", leafSize_, 1, MvhParameters::kMaxLeafSize,
                "mvh, BLASes in it, too: triangles in a leaf");
    line.text("--zeta", "auto|ONE[,BOTH]", zeta_,
              "mvh: the part of a box that a cut of one plane takes off, and of both");
}

EncodeOptions FormOptions::withLevels(const EncodeOptions& defaults) const {
    EncodeOptions options = defaults;
    take(tlasForm_, options.tlasForm);
    take(blasForm_, options.blasForm);
    return options;
}

void FormOptions::check(std::string_view form, const EncodeOptions& defaults) const {
    const EncodeOptions levels = withLevels(defaults);
    const bool isTwoLevel = form == TwoLevelForm::kName, isQuantized = form == QuantizedForm::kName,
               isMvh = form == MvhForm::kName;
    const bool hasQuantizedLevel =
        isTwoLevel && (levels.tlasForm == TlasForm::quantized || levels.blasForm == BlasForm::quantized);
    const bool hasMvhLevel = isTwoLevel && levels.blasForm == BlasForm::mvh;
    if (isTwoLevel && !hasQuantizedLevel && line_.isGiven("--bits"))
        throw Error(ErrorKind::usage, "--bits: neither level is in the quantized form: leave it out");
    const struct {
        std::string_view name, theirs;
        bool isUsed;
    } uses[] = {
        {"--tlas-form", TwoLevelForm::kName, isTwoLevel},
        {"--blas-form", TwoLevelForm::kName, isTwoLevel},
        {"--blas-size", TwoLevelForm::kName, isTwoLevel},
        {"--record-bytes", QuantizedForm::kName, isQuantized},
        {"--bits", QuantizedForm::kName, isQuantized || hasQuantizedLevel},
        {"--mvh-build", MvhForm::kName, isMvh},
        {"--leaf-size", MvhForm::kName, isMvh || hasMvhLevel},
        {"--zeta", MvhForm::kName, isMvh},
    };
    for (const auto& [name, theirs, isUsed] : uses)
        if (!isUsed && line_.isGiven(name))
            throw Error(ErrorKind::usage, std::string(name) + ": is for --form " + std::string(theirs) +
                                              ", not " + std::string(form) + ": leave it out");
    if (recordBytes_ != 0 && recordBytes_ != 8 && recordBytes_ != 16)
        throw Error(ErrorKind::usage, "--record-bytes: records have 8 bytes or 16");
    if (recordBytes_ == 8 && bits_ != 0 && bits_ != ShortRecord::kBits)
        throw Error(ErrorKind::usage, "--bits: records of 8 bytes have 6: leave it out");
    EncodeOptions parsed;
    readZeta(parsed);
}

bool FormOptions::isShort(bool inClusters) const {
    return recordBytes_ == 8 || (recordBytes_ == 0 && bits_ == ShortRecord::kBits && inClusters);
}

EncodeOptions FormOptions::fill(std::string_view form, const EncodeOptions& defaults) {
    EncodeOptions options = form == TwoLevelForm::kName ? withLevels(defaults) : defaults;
    if (form == QuantizedForm::kName) {
        if (recordBytes_ == 8) bits_ = ShortRecord::kBits;
        fill(bits_, options.bits);
    } else if (form == MvhForm::kName) {
        fillMvh(options);
    } else if (form == TwoLevelForm::kName) {
        tlasForm_ = levelForms<TlasForm>()[size_t(options.tlasForm)];
        blasForm_ = levelForms<BlasForm>()[size_t(options.blasForm)];
        fill(blasSize_, options.blasSize);
        if (options.tlasForm == TlasForm::quantized || options.blasForm == BlasForm::quantized)
            fill(bits_, options.bits);
        if (options.blasForm == BlasForm::mvh) fill(leafSize_, options.blasLeafSize);
    }
    return options;
}

void FormOptions::fill(uint32_t& given, uint32_t& option) {
    if (given == 0) given = option;
    option = given;
}

void FormOptions::fillMvh(EncodeOptions& options) {
    if (options.mvhBuild == MvhBuild::given) {
        // These encode another tree alike.
        if (mvhBuild_.empty() && leafSize_ == 0 && zeta_.empty()) return;
        options.mvhBuild = MvhBuild::best;
        options.zeta = options.zetaOfBoth = 0;
        options.cutAxes = 0;
    }
    if (mvhBuild_.empty()) mvhBuild_ = kMvhBuilds[0].name;
    options.mvhBuild = mvhBuild_ == kMvhBuilds[0].name ? MvhBuild::best : MvhBuild::paper;
    fill(leafSize_, options.leafSize);
    if (zeta_.empty()) zeta_ = "auto";
    readZeta(options);
}

void FormOptions::readZeta(EncodeOptions& options) const {
    if (zeta_.empty() || zeta_ == "auto") return;
    const size_t comma = std::min(zeta_.find(','), zeta_.size());
    options.zeta = zetaNumber(zeta_, zeta_.substr(0, comma), MvhRule::kMaxZeta);
    if (comma < zeta_.size())
        options.zetaOfBoth = zetaNumber(zeta_, zeta_.substr(comma + 1), MvhRule::kMaxZetaOfBoth);
}

}  // namespace bvhio
