#include "compress/tlas.h"

#include "core/buffer.h"

namespace bvhio {

RootPlaces DecodedTlas::places(bool areRuns) {
    RootPlaces places;
    places.frames = {InsetFrame(bvh.nodes[0].bounds)};
    if (!areRuns) {
        places.bounds.resize(bvh.nodes.size() / 2);
        places.insets.resize(bvh.nodes.size() / 2);
    }
    Buffer<Node> named(bvh.nodes.size());
    for (size_t i = 0; i < named.size(); ++i) {
        named[i] = bvh.nodes[i];
        const Node& leaf = bvh.nodes[i];
        if (!leaf.isLeaf()) continue;
        if (areRuns) {
            named[i] = {leaf.bounds, uint32_t(places.runs.size()), 1};
            places.runs.push_back({leaf.first, leaf.primitiveCount});
            places.bounds.push_back(leaf.bounds);
            places.insets.push_back(insets[i]);
        } else {
            places.bounds[leaf.first] = leaf.bounds;
            places.insets[leaf.first] = insets[i];
        }
    }
    bvh.nodes = std::move(named).share();
    return places;
}

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
