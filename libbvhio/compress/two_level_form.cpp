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

/// What a top level of one leaf owns: the one BLAS.
SharedArray<uint32_t> oneEntry() {
    return std::vector<uint32_t>{0};
}

/// Whether the primitives of a BLAS are one run, whose length says what tree is over it.
bool areRuns(BlasForm form) {
    return form == BlasForm::mvh;
}

/// Of BLASes that are not over runs.
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

/// A mesh's tree as a BLAS: primitives count through the scene, the root has the mesh's box, and no other box
/// leaves that.
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

/// A mesh without a tree: all triangles in one leaf, which is larger than leaves may be.
Bvh oneLeaf(const Aabb& meshBounds, PrimitiveRange triangles) {
    AlignedVector<Node> nodes{{meshBounds, 0, triangles.count}, {}};
    std::vector<uint32_t> primitives(triangles.count);
    std::iota(primitives.begin(), primitives.end(), triangles.first);
    return {std::move(nodes), std::move(primitives)};
}

/// The meshes' trees as BLASes of a form.
GatheredTrees gatherMeshes(const PlacedBlases& placed, const Scene& scene, const InstancedBvh& bvh,
                           BlasForm form) {
    std::vector<Bvh> trees;
    for (size_t i = 0; i < bvh.meshes.size(); ++i) {
        const SceneMesh& mesh = scene.meshes[i];
        Bvh tree = within(bvh.meshes[i], placed.meshBounds[i], mesh.firstTriangle);
        if (!areRuns(form))
            tree = divideLeaves(tree, maxLeafSizeOf(form));  // tree by tree, as new pairs stand behind all
        else if (tree.primitives.size() != mesh.triangleCount)
            tree = oneLeaf(placed.meshBounds[i], placed.runs[i]);  // it has parts of triangles
        trees.push_back(std::move(tree));
    }
    return gatherTrees(trees);
}

/// The bottom level, and the primitives that it is over.
struct Bottom {
    TwoLevelForm::Blases blases;
    SharedArray<uint32_t> primitives;
};

/// Encodes trees over runs, whose roots are at `places`. Puts each run into the order of its tree.
Bottom encodeRuns(Runs runs, const RootPlaces& places, const TwoLevelForm::Options& options) {
    MvhBlases blases =
        MvhBlases::encode(options.blasLeafSize, places, runs.primitives, runs.boxes, runs.ordered);
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

/// The top level of an instanced scene, whose leaves name entries: those follow each other as the leaves do.
struct EntryTree {
    Bvh bvh;
    SharedArray<uint32_t> instances;  // that the entries stand for
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

    // The top level: its leaves own runs of primitives, or name trees of the bottom level.
    Runs runs;
    if (overRuns) {
        runs = gatherRuns(scene, levels.bottom, bvh.primitives, MvhRuns(options.blasLeafSize));
        levels.top = withRuns(levels.top, runs);
    } else {
        levels.top.primitives = oneEntry();
    }
    Tlas tlas = encodeTlas(scene, levels.top, options);

    // The bottom level: its roots take over the boxes that the top level's leaves have now.
    const DecodedTlas top = decodeTlas(tlas);
    Bottom bottom = overRuns ? encodeRuns(std::move(runs), top.placesOfRuns(), options)
                             : encodeTrees(levels.bottom, bvh.primitives, top.placesOfTrees(), options);

    TwoLevelForm form(std::move(tlas), std::move(bottom.blases), std::move(bottom.primitives),
                      options.blasSize);
    refuseTooDeep(form.decode());  // BLASes may be deeper than what they stand for
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
    Bottom bottom =
        overRuns
            ? encodeRuns(gatherRuns(scene, meshes.forest, meshes.primitives, MvhRuns(options.blasLeafSize)),
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
            "the scene has instances, and so more than one tree: build without --two-level for a single one");
    return joinLevels(decodeLevels(), primitives_);
}

TwoLevelForm::Options TwoLevelForm::options() const {
    Options options;
    options.tlasForm = TlasForm(tlas_.index());
    options.blasForm = BlasForm(blases_.index());
    if (const auto* quantized = std::get_if<QuantizedTlas>(&tlas_)) options.bits = quantized->form().bits();
    if (const auto* quantized = std::get_if<QuantizedBlases>(&blases_))
        options.bits = quantized->form().bits();
    if (const auto* mvh = std::get_if<MvhBlases>(&blases_)) options.blasLeafSize = mvh->shape().leafSize();
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
