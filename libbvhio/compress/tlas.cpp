#include "compress/tlas.h"

#include "core/buffer.h"

namespace bvhio {

RootPlaces DecodedTlas::placesOfTrees() const {
    RootPlaces places;
    places.frames = {InsetFrame(bvh.nodes[0].bounds)};
    places.bounds.resize(bvh.nodes.size() / 2);
    places.insets.resize(bvh.nodes.size() / 2);
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        const Node& leaf = bvh.nodes[i];
        if (!leaf.isLeaf()) continue;
        places.bounds[leaf.first] = leaf.bounds;
        places.insets[leaf.first] = insets[i];
    }
    return places;
}

RootPlaces DecodedTlas::placesOfRuns() const {
    RootPlaces places;
    places.frames = {InsetFrame(bvh.nodes[0].bounds)};
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        const Node& leaf = bvh.nodes[i];
        if (!leaf.isLeaf()) continue;
        places.runs.push_back({leaf.first, leaf.primitiveCount});
        places.bounds.push_back(leaf.bounds);
        places.insets.push_back(insets[i]);
    }
    return places;
}

Bvh DecodedTlas::withRunsNumbered() const {
    Buffer<Node> nodes(bvh.nodes.size());
    uint32_t run = 0;
    for (size_t i = 0; i < nodes.size(); ++i) {
        nodes[i] = bvh.nodes[i];
        if (nodes[i].isLeaf()) nodes[i] = {nodes[i].bounds, run++, 1};
    }
    return {std::move(nodes).share(), bvh.primitives};
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
