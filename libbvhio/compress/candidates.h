// The encodings that a search for the best one tries: forms with their options. Each form lists its own in
// kCandidates.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "compress/forms.h"

namespace bvhio {

/// A row: a form, and its options.
struct EncodingCandidate {
    std::string_view form;
    std::string_view parameters;  // as bvh-compress takes them, "--bits 6"; empty for the form's defaults
    EncodeOptions options{};

    /// "quantized --bits 6".
    std::string name() const {
        return std::string(form) + (parameters.empty() ? "" : " ") + std::string(parameters);
    }
};

/// Returns all candidates, at least one of each form. The first is aabb, with which others are compared.
std::span<const EncodingCandidate> encodingCandidates();

}  // namespace bvhio
