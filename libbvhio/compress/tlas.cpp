#include "compress/tlas.h"

namespace bvhio {

DecodedTlas AabbTlas::decode() const {
    DecodedTlas decoded{form_.decode(), {}};
    const InsetFrame frame(bounds());
    decoded.insets.reserve(decoded.bvh.nodes.size());
    for (const Node& node : decoded.bvh.nodes) decoded.insets.push_back(frame.insets(node.bounds));
    return decoded;
}

DecodedTlas QuantizedTlas::decode() const {
    DecodedTlas decoded;
    decoded.insets.resize(2 * form_.records().size() + 2);
    decoded.bvh = form_.decode(decoded.insets.data());
    return decoded;
}

}  // namespace bvhio
