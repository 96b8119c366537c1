// The options of the mvh form, for tools that encode.
#pragma once

#include <charconv>

#include "common/command_line.h"
#include "compress/forms.h"
#include "core/error.h"

namespace bvhio {

/// Empty or 0 where not given.
class MvhOptions {
  public:
    explicit MvhOptions(CommandLine& line) {
        line.choice("--mvh-build", build_, kBuilds, "mvh: how triangles are divided");
        line.number("--leaf-size", leafSize_, 1, MvhParameters::kMaxLeafSize, "mvh: triangles in a leaf");
        line.text("--zeta", "auto|ONE[,BOTH]", zeta_,
                  "mvh: the part of a box that a cut of one plane takes off, and of both");
    }

    /// Adds what was given to the options for `form`, and fills in the rest. Throws Error{usage} where
    /// another form has no use for it.
    void addTo(EncodeOptions& options, std::string_view form) {
        if (form != MvhForm::kName) {
            for (const auto& [name, given] : {std::pair{"--mvh-build", !build_.empty()},
                                              {"--leaf-size", leafSize_ != 0},
                                              {"--zeta", !zeta_.empty()}})
                if (given)
                    throw Error(ErrorKind::usage, std::string(name) + ": is for --form mvh, not " +
                                                      std::string(form) + ": leave it out");
            return;
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
