// The encodings that are tried where the best one is wanted: forms with their options. Each form names its
// own (kCandidates).
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "compress/forms.h"

namespace bvhio {

/// A row: a form, and how it is to encode.
struct EncodingCandidate {
    std::string_view form;
    std::string_view parameters;  // as bvh-compress takes them, "--bits 6"; empty for the form's defaults
    EncodeOptions options{};

    /// "quantized --bits 6".
    std::string name() const {
        return std::string(form) + (parameters.empty() ? "" : " ") + std::string(parameters);
    }
};

/// Every form at least once; aabb, which the others are compared with, first.
std::span<const EncodingCandidate> encodingCandidates();

}  // namespace bvhio
