#include "compress/candidates.h"

namespace bvhio {

std::span<const EncodingCandidate> encodingCandidates() {
    static const EncodingCandidate kTable[] = {
        {"aabb", ""},
        {"ssh", ""},
    };
    return kTable;
}

}  // namespace bvhio
