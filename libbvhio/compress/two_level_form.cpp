#include "compress/two_level_form.h"

#include <algorithm>
#include <numeric>

#include "compress/divide_leaves.h"
#include "compress/forest.h"
#include "core/buffer.h"
#include "core/error.h"
#include "tree/depth.h"

namespace bvhio {
namespace {

/// What a top level of one leaf owns: the one BLAS.
SharedArray<uint32_t> oneEntry() {
    return std::vector<uint32_t>{0};
}

/// What the forms of BLASes differ in, but for how they are encoded.
struct BlasTraits {
    bool areRuns;          // primitives of a BLAS are one run, whose length says what tree is over it
    uint32_t maxLeafSize;  // of trees that are not over runs
};

template <class Blases>
constexpr BlasTraits traitsOfBlases() {
    if constexpr (Blases::kAreRuns)
        return {true, 0};
    else
        return {false, Blases::kMaxLeafSize};
}

BlasTraits traitsOf(BlasForm form) {
    return []<class... Forms>(const std::variant<Forms...>*, BlasForm row) {
        constexpr BlasTraits kTable[] = {traitsOfBlases<Forms>()...};
        return kTable[size_t(row)];
    }(static_cast<const TwoLevelForm::Blases*>(nullptr), form);
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

/// Primitives tree by tree, each with a box that must hold it there: of a triangle that was split, what is of
/// it in its leaf.
struct Runs {
    std::vector<PrimitiveRange> ranges;  // of each tree
    std::vector<uint32_t> primitives;
    std::vector<Aabb> boxes;
    std::vector<uint32_t>
        ordered;  // where a tree's run starts that has the shape of an MVH: its length, else 0
};

/// How many primitives are below a node that has the shape of an MVH; 0 if it has another.
uint32_t countOfMvh(const MvhRuns& shape, const Forest& forest, const Node& node) {
    if (node.isLeaf()) return shape.root({0, node.primitiveCount}).isLeaf() ? node.primitiveCount : 0;
    const uint32_t left = countOfMvh(shape, forest, forest.nodes[node.left()]);
    const uint32_t right = left == 0 ? 0 : countOfMvh(shape, forest, forest.nodes[node.right()]);
    const MvhRun run = shape.root({0, left + right});
    return right != 0 && !run.isLeaf() && shape.left(run).count == left ? run.count : 0;
}

/// Gathers each tree's primitives into one run. A tree that has the shape of an MVH, as one that was decoded,
/// keeps its order.
Runs gatherRuns(const Scene& scene, const Forest& forest, std::span<const uint32_t> primitives,
                const MvhRuns& shape) {
    Runs runs;
    runs.primitives.reserve(primitives.size());
    runs.boxes.reserve(primitives.size());
    std::vector<Node> waiting;
    for (const Node& root : forest.roots) {
        const auto first = uint32_t(runs.primitives.size());
        waiting = {root};
        while (!waiting.empty()) {
            const Node node = waiting.back();
            waiting.pop_back();
            if (!node.isLeaf()) {
                waiting.push_back(forest.nodes[node.right()]);
                waiting.push_back(forest.nodes[node.left()]);
                continue;
            }
            for (const uint32_t primitive : primitives.subspan(node.first, node.primitiveCount)) {
                Aabb box = bounds(scene.triangle(primitive));
                for (int axis = 0; axis < 3; ++axis) {
                    box.min[axis] = std::max(box.min[axis], node.bounds.min[axis]);
                    box.max[axis] = std::min(box.max[axis], node.bounds.max[axis]);
                }
                runs.primitives.push_back(primitive);
                runs.boxes.push_back(box);
            }
        }
        runs.ranges.push_back({first, uint32_t(runs.primitives.size()) - first});
    }
    runs.ordered.resize(runs.primitives.size());
    for (size_t i = 0; i < runs.ranges.size(); ++i)
        runs.ordered[runs.ranges[i].first] = countOfMvh(shape, forest, forest.roots[i]);
    return runs;
}

/// The top level whose leaves own the runs, not the trees over them.
Bvh withRuns(const Bvh& top, const Runs& runs) {
    Buffer<Node> nodes(top.nodes.size());
    for (size_t i = 0; i < nodes.size(); ++i) {
        const Node& node = top.nodes[i];
        nodes[i] = node;
        if (node.isLeaf())
            nodes[i] = {node.bounds, runs.ranges[node.first].first, runs.ranges[node.first].count};
    }
    return {std::move(nodes).share(), std::vector<uint32_t>(runs.primitives)};
}

void refuseTooDeep(const Bvh& bvh) {
    if (depthOf(bvh) > kMaxDepth)
        throw Error(ErrorKind::unsupported,
                    "the tree's lowest leaves lie too deep to be BLASes: use another --form or a larger "
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
                           const BlasTraits& form) {
    std::vector<Bvh> trees;
    for (size_t i = 0; i < bvh.meshes.size(); ++i) {
        const SceneMesh& mesh = scene.meshes[i];
        Bvh tree = within(bvh.meshes[i], placed.meshBounds[i], mesh.firstTriangle);
        if (!form.areRuns)
            tree = divideLeaves(tree, form.maxLeafSize);  // tree by tree, as new pairs stand behind all
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
    const bool areRuns = traitsOf(options.blasForm).areRuns;

    // The top level: its leaves own runs of primitives, or name trees of the bottom level.
    Runs runs;
    if (areRuns) {
        runs = gatherRuns(scene, levels.bottom, bvh.primitives, MvhRuns(options.blasLeafSize));
        levels.top = withRuns(levels.top, runs);
    } else {
        levels.top.primitives = oneEntry();
    }
    Tlas tlas = encodeTlas(scene, levels.top, options);

    // The bottom level: its roots take over the boxes that the top level's leaves have now.
    const DecodedTlas top = decodeTlas(tlas);
    Bottom bottom = areRuns ? encodeRuns(std::move(runs), top.placesOfRuns(), options)
                            : encodeTrees(levels.bottom, bvh.primitives, top.placesOfTrees(), options);

    TwoLevelForm form(std::move(tlas), std::move(bottom.blases), std::move(bottom.primitives),
                      options.blasSize);
    refuseTooDeep(form.decode());  // BLASes may be deeper than what they stand for
    return form;
}

TwoLevelForm TwoLevelForm::encodeInstances(const Scene& scene, const InstancedBvh& bvh,
                                           const Options& options) {
    const BlasTraits blasTraits = traitsOf(options.blasForm);
    EntryTree top = entryTree(bvh.top);
    Tlas tlas = encodeTlas(scene, top.bvh, options);

    // A BLAS for each mesh, whose root has the mesh's box.
    PlacedBlases placed(scene, std::move(top.instances), blasTraits.areRuns);
    GatheredTrees meshes = gatherMeshes(placed, scene, bvh, blasTraits);
    const RootPlaces places = placed.places();
    Bottom bottom =
        blasTraits.areRuns
            ? encodeRuns(gatherRuns(scene, meshes.forest, meshes.primitives, MvhRuns(options.blasLeafSize)),
                         places, options)
            : encodeTrees(meshes.forest, meshes.primitives, places, options);
    return {std::move(tlas), std::move(bottom.blases), std::move(bottom.primitives), Options{}.blasSize,
            std::move(placed)};
}

TwoLevels TwoLevelForm::decodeLevels() const {
    const DecodedTlas top = decodeTlas(tlas_);
    const bool ownsRuns = !isInstanced() && traitsOf(BlasForm(blases_.index())).areRuns;
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

PlacedBlases::PlacedBlases(const Scene& scene, SharedArray<uint32_t> leafOrder, bool areRuns)
    : instances(std::move(leafOrder)), meshBounds(scene.meshes.size()) {
    const std::vector<InstanceEntry> all = instanceEntries(scene);
    for (const uint32_t instance : instances) entries.push_back(all[instance]);
    for (size_t i = 0; i < meshBounds.size(); ++i) meshBounds[i] = scene.boundsOf(scene.meshes[i]);
    if (areRuns)
        for (const SceneMesh& mesh : scene.meshes) runs.push_back({mesh.firstTriangle, mesh.triangleCount});
}

RootPlaces PlacedBlases::places() const {
    RootPlaces places{{}, meshBounds, std::vector<InsetBox>(meshBounds.size()), runs};
    for (const Aabb& box : meshBounds) places.frames.emplace_back(box);
    return places;
}

Bvh TwoLevelForm::decode() const {
    if (isInstanced())
        throw Error(
            ErrorKind::usage,
            "the scene has instances, whose trees do not make one: build without --two-level for that");
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
