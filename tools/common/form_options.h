// The options of forms, for tools that encode: each class declares a form's, and adds what was given.
#pragma once

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <utility>

#include "common/command_line.h"
#include "compress/forms.h"
#include "core/error.h"

namespace bvhio {

/// Throws Error{usage} for the first of some options, all for the form `theirs`, that was given though the
/// form is another one.
inline void refuseForOtherForm(std::initializer_list<std::pair<std::string_view, bool>> options,
                               std::string_view theirs, std::string_view form) {
    for (const auto& [name, given] : options)
        if (given)
            throw Error(ErrorKind::usage, std::string(name)
                                              .append(": is for --form ")
                                              .append(theirs)
                                              .append(", not ")
                                              .append(form)
                                              .append(": leave it out"));
}

/// Options of the quantized forms: 0 where not given.
class QuantizedOptions {
  public:
    explicit QuantizedOptions(CommandLine& line) {
        line.number("--bits", bits_, QuantizedRecord::kMinBits, QuantizedRecord::kMaxBits,
                    "quantized: bits a plane");
        line.number("--record-bytes", recordBytes_, 8, 16,
                    "quantized: bytes of two siblings' record, 8 or 16");
    }

    /// Adds what was given to the options for `form`, and fills in the rest. For after TwoLevelOptions.
    void addTo(EncodeOptions& options, std::string_view form) {
        const bool isLevel = form == TwoLevelForm::kName && (options.tlasForm == TlasForm::quantized ||
                                                             options.blasForm == BlasForm::quantized);
        if (form != QuantizedForm::kName)
            refuseForOtherForm({{"--record-bytes", recordBytes_ != 0}}, QuantizedForm::kName, form);
        if (form == TwoLevelForm::kName && !isLevel && bits_ != 0)
            throw Error(ErrorKind::usage, "--bits: neither level is in the quantized form: leave it out");
        if (form != QuantizedForm::kName && form != TwoLevelForm::kName)
            refuseForOtherForm({{"--bits", bits_ != 0}}, QuantizedForm::kName, form);
        if (recordBytes_ != 0 && recordBytes_ != 8 && recordBytes_ != 16)
            throw Error(ErrorKind::usage, "--record-bytes: records have 8 bytes or 16");
        if (recordBytes_ == 8 && bits_ != 0 && bits_ != ShortRecord::kBits)
            throw Error(ErrorKind::usage, "--bits: records of 8 bytes have 6: leave it out");
        isShort_ = recordBytes_ == 8;
        isShortInClusters_ = recordBytes_ == 0 && bits_ == ShortRecord::kBits;
        if (form != QuantizedForm::kName && !isLevel) return;
        if (bits_ == 0) bits_ = isShort_ ? ShortRecord::kBits : options.bits;
        options.bits = bits_;
    }
    /// Whether form quantized is to have 8-byte records. For after addTo.
    bool isShort(bool inClusters) const { return isShort_ || (isShortInClusters_ && inClusters); }

  private:
    uint32_t bits_ = 0, recordBytes_ = 0;
    bool isShort_ = false, isShortInClusters_ = false;
};

/// Options of the two-level form: empty or 0 where not given.
class TwoLevelOptions {
  public:
    explicit TwoLevelOptions(CommandLine& line) {
        line.choice("--tlas-form", tlasForm_, namesOf<TlasForm>(), "two-level: how the top level is stored");
        line.choice("--blas-form", blasForm_, namesOf<BlasForm>(), "two-level: how BLASes are stored");
        line.number("--blas-size", blasSize_, 1, kMaxLeafSize,
                    "two-level: most references in a BLAS, where leaves allow it");
    }

    /// Adds what was given to the options for `form`, and fills in the rest.
    void addTo(EncodeOptions& options, std::string_view form) {
        if (form != TwoLevelForm::kName) {
            refuseForOtherForm({{"--tlas-form", !tlasForm_.empty()},
                                {"--blas-form", !blasForm_.empty()},
                                {"--blas-size", blasSize_ != 0}},
                               TwoLevelForm::kName, form);
            return;
        }
        take(tlasForm_, options.tlasForm);
        take(blasForm_, options.blasForm);
        if (blasSize_ == 0) blasSize_ = options.blasSize;
        options.blasSize = blasSize_;
    }

  private:
    template <class LevelForm>
    static std::vector<NamedValue> namesOf() {
        std::vector<NamedValue> names;
        for (size_t i = 0; i < levelForms<LevelForm>().size(); ++i)
            names.push_back({levelForms<LevelForm>()[i], i == 0 ? "the default" : ""});
        return names;
    }
    template <class LevelForm>
    static void take(std::string& name, LevelForm& form) {
        const auto names = levelForms<LevelForm>();
        if (name.empty()) name = names[size_t(form)];
        form = LevelForm(std::find(names.begin(), names.end(), name) - names.begin());
    }

    std::string tlasForm_, blasForm_;
    uint32_t blasSize_ = 0;
};

/// Options of the mvh form, and of BLASes in it: empty or 0 where not given.
class MvhOptions {
  public:
    explicit MvhOptions(CommandLine& line) {
        line.choice("--mvh-build", build_, kBuilds, "mvh: how triangles are divided");
        line.number("--leaf-size", leafSize_, 1, MvhParameters::kMaxLeafSize,
                    "mvh, BLASes in it, too: triangles in a leaf");
        line.text("--zeta", "auto|ONE[,BOTH]", zeta_,
                  "mvh: the part of a box that a cut of one plane takes off, and of both");
    }

    /// Adds what was given to the options for `form`, and fills in the rest. Throws Error{usage} where
    /// another form has no use for it. For after TwoLevelOptions.
    void addTo(EncodeOptions& options, std::string_view form) {
        if (form != MvhForm::kName) {
            const bool isLevel = form == TwoLevelForm::kName && options.blasForm == BlasForm::mvh;
            if (isLevel) {
                if (leafSize_ == 0) leafSize_ = options.leafSize;
                options.leafSize = leafSize_;
            }
            refuseForOtherForm({{"--mvh-build", !build_.empty()},
                                {"--leaf-size", leafSize_ != 0 && !isLevel},
                                {"--zeta", !zeta_.empty()}},
                               MvhForm::kName, form);
            return;
        }
        if (options.mvhBuild == MvhBuild::given) {
            // These encode another tree alike.
            if (build_.empty() && leafSize_ == 0 && zeta_.empty()) return;
            options.mvhBuild = MvhBuild::best;
            options.zeta = options.zetaOfBoth = 0;
            options.cutAxes = 0;
        }
        if (build_.empty()) build_ = kBuilds[0].name;
        options.mvhBuild = build_ == kBuilds[0].name ? MvhBuild::best : MvhBuild::paper;
        if (leafSize_ == 0) leafSize_ = options.leafSize;
        options.leafSize = leafSize_;
        if (zeta_.empty()) zeta_ = "auto";
        if (zeta_ == "auto") return;
        const size_t comma = std::min(zeta_.find(','), zeta_.size());
        options.zeta = number(zeta_.substr(0, comma), MvhRule::kMaxZeta);
        if (comma < zeta_.size())
            options.zetaOfBoth = number(zeta_.substr(comma + 1), MvhRule::kMaxZetaOfBoth);
    }

  private:
    float number(const std::string& text, float max) const {
        float value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || !(value >= 0.01f && value <= max))
            throw Error(ErrorKind::usage, "--zeta: '" + zeta_ +
                                              "' is neither auto nor a number from 0.01 to 0.99, with a "
                                              "second one up to 0.5 behind a comma");
        return value;
    }

    inline static const std::vector<NamedValue> kBuilds = {
        {"best", "the default: the best of three axes and three orders at each node"},
        {"paper", "along the longest axis, with one zeta for all cuts"},
    };
    std::string build_, zeta_;
    uint32_t leafSize_ = 0;
};

}  // namespace bvhio
