// The table of encodings that are tried where the best one is wanted: forms with their parameters.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "compress/form_concept.h"

namespace bvhio {

/// A row: a form, and what it is told.
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
