#include "compress/two_level_form.h"

#include <numeric>

#include "compress/divide_leaves.h"
#include "compress/forest.h"
#include "compress/primitive_runs.h"
#include "core/buffer.h"
#include "core/error.h"
#include "tree/depth.h"

namespace bvhio {
namespace {

/// Returns the primitive array of a top level of one leaf: the only BLAS.
SharedArray<uint32_t> oneEntry() {
    return std::vector<uint32_t>{0};
}

/// Returns whether the primitives of a BLAS are one run, whose length alone gives the shape of its tree.
bool areRuns(BlasForm form) {
    return form == BlasForm::mvh;
}

/// Returns the largest leaf of BLASes that are not over runs.
uint32_t maxLeafSizeOf(BlasForm form) {
    switch (form) {
        case BlasForm::ssh:
            return SshBlases::kMaxLeafSize;
        case BlasForm::quantized:
            return QuantizedBlases::kMaxLeafSize;
        case BlasForm::mvh:
        case BlasForm::aabb:
            break;
    }
    return AabbBlases::kMaxLeafSize;
}

TwoLevelForm::Tlas encodeTlas(const Scene& scene, const Bvh& top, const TwoLevelForm::Options& options) {
    switch (options.tlasForm) {
        case TlasForm::quantized:
            return QuantizedTlas(QuantizedForm::encode(scene, top, {.bits = options.bits}));
        case TlasForm::aabb:
            break;
    }
    return AabbTlas(AabbForm::encode(scene, top, {}));
}

DecodedTlas decodeTlas(const TwoLevelForm::Tlas& tlas) {
    return std::visit([](const auto& level) { return level.decode(); }, tlas);
}

void refuseTooDeep(const Bvh& bvh) {
    if (depthOf(bvh) > kMaxDepth)
        throw Error(ErrorKind::unsupported,
                    "the tree's lowest leaves are too deep to become BLASes: use another --form or a larger "
                    "--blas-size");
}

/// Returns a mesh's tree as a BLAS: its primitives count through the scene, its root has the mesh's box, and
/// all other boxes are clipped to this box.
Bvh within(const Bvh& bvh, const Aabb& meshBounds, uint32_t firstTriangle) {
    Buffer<Node> nodes(bvh.nodes.size());
    for (size_t i = 0; i < nodes.size(); ++i) {
        nodes[i] = bvh.nodes[i];
        if (i == 1) continue;
        nodes[i].bounds = {max(nodes[i].bounds.min, meshBounds.min),
                           min(nodes[i].bounds.max, meshBounds.max)};
    }
    nodes[0].bounds = meshBounds;
    std::vector<uint32_t> primitives(bvh.primitives.begin(), bvh.primitives.end());
    for (uint32_t& primitive : primitives) primitive += firstTriangle;
    return {std::move(nodes).share(), std::move(primitives)};
}

/// Returns a single leaf with all triangles of a mesh. It may be larger than leaves of valid trees.
Bvh oneLeaf(const Aabb& meshBounds, PrimitiveRange triangles) {
    AlignedVector<Node> nodes{{meshBounds, 0, triangles.count}, {}};
    std::vector<uint32_t> primitives(triangles.count);
    std::iota(primitives.begin(), primitives.end(), triangles.first);
    return {std::move(nodes), std::move(primitives)};
}

/// Returns the meshes' trees as BLASes of a form.
GatheredTrees gatherMeshes(const PlacedBlases& placed, const Scene& scene, const InstancedBvh& bvh,
                           BlasForm form) {
    std::vector<Bvh> trees;
    for (size_t i = 0; i < bvh.meshes.size(); ++i) {
        const SceneMesh& mesh = scene.meshes[i];
        Bvh tree = within(bvh.meshes[i], placed.meshBounds[i], mesh.firstTriangle);
        if (!areRuns(form))
            tree = divideLeaves(tree, maxLeafSizeOf(form));  // tree by tree: new pairs go after all others
        else if (tree.primitives.size() != mesh.triangleCount)
            tree = oneLeaf(placed.meshBounds[i], placed.runs[i]);  // the tree has parts of split triangles
        trees.push_back(std::move(tree));
    }
    return gatherTrees(trees);
}

/// A bottom level, and its primitives.
struct Bottom {
    TwoLevelForm::Blases blases;
    SharedArray<uint32_t> primitives;
};

/// Encodes trees over runs, whose roots are at `places`. Puts each run into the order of its tree.
Bottom encodeRuns(Runs runs, const RootPlaces& places, const TwoLevelForm::Options& options) {
    NibbleBlases blases =
        NibbleBlases::encode(options.blasLeafSize, places, runs.primitives, runs.boxes, runs.ordered);
    return {std::move(blases), std::move(runs.primitives)};
}

/// Encodes the trees of a forest, whose roots are at `places`.
Bottom encodeTrees(const Forest& forest, const SharedArray<uint32_t>& primitives, const RootPlaces& places,
                   const TwoLevelForm::Options& options) {
    const size_t references = primitives.size();
    switch (options.blasForm) {
        case BlasForm::ssh:
            return {SshBlases::encode(forest, places, references, {}), primitives};
        case BlasForm::quantized:
            return {QuantizedBlases::encode(forest, places, references, {.bits = options.bits}), primitives};
        case BlasForm::mvh:  // are runs
        case BlasForm::aabb:
            break;
    }
    return {AabbBlases::encode(forest, places, references, {}), primitives};
}

/// The top level of an instanced scene. Its leaves refer to entries, which are in the order of the leaves.
struct EntryTree {
    Bvh bvh;
    SharedArray<uint32_t> instances;  // of the entries
};

EntryTree entryTree(const Bvh& top) {
    Buffer<Node> nodes(top.nodes.size());
    Buffer<uint32_t> instances(top.primitives.size());
    uint32_t entry = 0;
    for (size_t i = 0; i < nodes.size(); ++i) {
        nodes[i] = top.nodes[i];
        if (!nodes[i].isLeaf()) continue;
        instances[entry] = top.primitives[nodes[i].first];
        nodes[i].first = entry++;
    }
    return {{std::move(nodes).share(), oneEntry()}, std::move(instances).share()};
}

}  // namespace

TwoLevelForm TwoLevelForm::encode(const Scene& scene, const Bvh& bvh, const Options& options) {
    TwoLevels levels = cutTree(bvh, options.blasSize);
    const bool overRuns = areRuns(options.blasForm);

    // The top level: its leaves own runs of primitives, or refer to trees of the bottom level.
    Runs runs;
    if (overRuns) {
        runs = gatherRuns(scene, levels.bottom, bvh.primitives, NibbleRuns(options.blasLeafSize));
        levels.top = withRuns(levels.top, runs);
    } else {
        levels.top.primitives = oneEntry();
    }
    Tlas tlas = encodeTlas(scene, levels.top, options);

    // The bottom level: its roots have the boxes of the top level's leaves, which encoding may have enlarged.
    const DecodedTlas top = decodeTlas(tlas);
    Bottom bottom = overRuns ? encodeRuns(std::move(runs), top.placesOfRuns(), options)
                             : encodeTrees(levels.bottom, bvh.primitives, top.placesOfTrees(), options);

    TwoLevelForm form(std::move(tlas), std::move(bottom.blases), std::move(bottom.primitives),
                      options.blasSize);
    refuseTooDeep(form.decode());  // BLASes may be deeper than the subtrees they replace
    return form;
}

TwoLevelForm TwoLevelForm::encodeInstances(const Scene& scene, const InstancedBvh& bvh,
                                           const Options& options) {
    const bool overRuns = areRuns(options.blasForm);
    EntryTree top = entryTree(bvh.top);
    Tlas tlas = encodeTlas(scene, top.bvh, options);

    // A BLAS for each mesh, whose root has the mesh's box.
    PlacedBlases placed(scene, std::move(top.instances), overRuns);
    GatheredTrees meshes = gatherMeshes(placed, scene, bvh, options.blasForm);
    const RootPlaces places = placed.places();
    Bottom bottom = overRuns ? encodeRuns(gatherRuns(scene, meshes.forest, meshes.primitives,
                                                     NibbleRuns(options.blasLeafSize)),
                                          places, options)
                             : encodeTrees(meshes.forest, meshes.primitives, places, options);
    return {std::move(tlas), std::move(bottom.blases), std::move(bottom.primitives), Options{}.blasSize,
            std::move(placed)};
}

TwoLevels TwoLevelForm::decodeLevels() const {
    const DecodedTlas top = decodeTlas(tlas_);
    const bool ownsRuns = !isInstanced() && areRuns(BlasForm(blases_.index()));
    const RootPlaces places = isInstanced() ? placed_.places()
                              : ownsRuns    ? top.placesOfRuns()
                                            : top.placesOfTrees();
    return {ownsRuns ? top.withRunsNumbered() : top.bvh,
            std::visit([&](const auto& level) { return level.decode(places); }, blases_)};
}

InstancedBvh TwoLevelForm::decodeInstances(const Scene& scene) const {
    const TwoLevels levels = decodeLevels();
    InstancedBvh bvh{{levels.top.nodes, placed_.instances}, {}};
    std::vector<Bvh> trees = separateTrees(levels.bottom, primitives_)->trees;
    for (size_t i = 0; i < trees.size(); ++i) {
        std::vector<uint32_t> own(trees[i].primitives.begin(), trees[i].primitives.end());
        for (uint32_t& triangle : own) triangle -= scene.meshes[i].firstTriangle;
        bvh.meshes.push_back({trees[i].nodes, std::move(own)});
    }
    return bvh;
}

Bvh TwoLevelForm::decode() const {
    if (isInstanced())
        throw Error(
            ErrorKind::usage,
            "the scene has instances, so it has several trees: build without --two-level for a single tree");
    return joinLevels(decodeLevels(), primitives_);
}

TwoLevelForm::Options TwoLevelForm::options() const {
    Options options;
    options.tlasForm = TlasForm(tlas_.index());
    options.blasForm = BlasForm(blases_.index());
    if (const auto* quantized = std::get_if<QuantizedTlas>(&tlas_)) options.bits = quantized->form().bits();
    if (const auto* quantized = std::get_if<QuantizedBlases>(&blases_))
        options.bits = quantized->form().bits();
    if (const auto* mvh = std::get_if<NibbleBlases>(&blases_)) options.blasLeafSize = mvh->shape().leafSize();
    if (!isInstanced()) options.blasSize = blasSize_;
    return options;
}

size_t TwoLevelForm::tlasBytes() const {
    return std::visit([](const auto& level) { return level.form().nodeBytes(); }, tlas_);
}

size_t TwoLevelForm::nodeBytes() const {
    return tlasBytes() + std::visit([](const auto& level) { return level.nodeBytes(); }, blases_) +
           placed_.bytes();
}

}  // namespace bvhio
