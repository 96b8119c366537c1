// The options of forms, for tools that encode.
#pragma once

#include <string>
#include <string_view>

#include "common/command_line.h"
#include "compress/form_concept.h"

namespace bvhio {

/// Declares the options of all forms. What was given is checked first, and then put among the parameters of a
/// form.
class FormOptions {
  public:
    explicit FormOptions(CommandLine& line);

    /// Throws Error{usage} for what was given though `form` has no use for it, or can't have it so. Levels of
    /// two whose form was not given are in `defaults`'.
    void check(std::string_view form, const EncodeOptions& defaults) const;

    /// Whether form quantized is to have 8-byte records. For before fill.
    bool isShort(bool inClusters) const;

    /// `defaults` with what was given. The rest of what `form` has a use for is filled in, so that provenance
    /// tells it. For after check.
    EncodeOptions fill(std::string_view form, const EncodeOptions& defaults);

  private:
    EncodeOptions withLevels(const EncodeOptions& defaults) const;
    void readZeta(EncodeOptions& options) const;
    static void fill(uint32_t& given, uint32_t& option);
    void fillMvh(EncodeOptions& options);

    CommandLine& line_;
    // 0 or empty where not given.
    uint32_t bits_ = 0, recordBytes_ = 0;
    std::string tlasForm_, blasForm_;
    uint32_t blasSize_ = 0;
    std::string mvhBuild_, zeta_;
    uint32_t leafSize_ = 0;
};

}  // namespace bvhio
