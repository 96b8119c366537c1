#include "compress/candidates.h"

#include <vector>

#include "compress/form_options.h"

namespace bvhio {
namespace {

template <class... Forms>
std::vector<EncodingCandidate> candidatesOf(const std::variant<Forms...>*) {
    std::vector<EncodingCandidate> all;
    const auto add = [&](std::string_view form, std::span<const std::string_view> candidates) {
        for (const std::string_view parameters : candidates)
            all.push_back({form, parameters, parseEncodeOptions(form, parameters)});
    };
    (add(Forms::kName, Forms::kCandidates), ...);
    return all;
}

}  // namespace

std::span<const EncodingCandidate> encodingCandidates() {
    static const std::vector<EncodingCandidate> kTable =
        candidatesOf(static_cast<const EncodedBvh*>(nullptr));
    return kTable;
}

}  // namespace bvhio
