#include "compress/blases.h"

#include "core/buffer.h"

namespace bvhio {

AabbBlases AabbLinks::encode(const Forest& forest, const RootPlaces&, size_t, const Form::Options&) {
    Buffer<Root> roots(forest.roots.size());
    for (size_t i = 0; i < roots.size(); ++i)
        roots[i] = {forest.roots[i].first, forest.roots[i].primitiveCount};
    return {std::move(roots).share(), AabbForm({forest.nodes, {}})};
}

Forest AabbLinks::decode(const AabbBlases& blases, const RootPlaces& places) {
    Buffer<Node> roots(blases.roots().size());
    for (size_t i = 0; i < roots.size(); ++i)
        roots[i] = {places.bounds[i], blases.roots()[i].first, blases.roots()[i].primitiveCount};
    return {std::move(roots).share(), blases.form().bvh().nodes};
}

SshBlases SshLinks::encode(const Forest& forest, const RootPlaces& places, size_t references,
                           const Form::Options&) {
    SshForm::Trees trees = SshForm::encodeTrees(forest, places.bounds, references);
    return {std::move(trees.roots), SshForm({}, std::move(trees.nodes), {})};
}

Forest SshLinks::decode(const SshBlases& blases, const RootPlaces& places) {
    return SshForm::decodeTrees({blases.roots(), blases.form().nodes()}, places.bounds);
}

QuantizedBlases QuantizedLinks::encode(const Forest& forest, const RootPlaces& places, size_t references,
                                       const Form::Options& options) {
    QuantizedForm::Trees trees = QuantizedForm::encodeTrees(forest, places, references, options.bits);
    return {std::move(trees.roots), QuantizedForm({}, options.bits, std::move(trees.records), {})};
}

Forest QuantizedLinks::decode(const QuantizedBlases& blases, const RootPlaces& places) {
    return QuantizedForm::decodeTrees({blases.roots(), blases.form().records()}, places,
                                      blases.form().bits());
}

}  // namespace bvhio
