#include "file/form_chunks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>

#include "core/bytes.h"
#include "core/refit.h"
#include "core/validate.h"
#include "file/scene_chunks.h"

namespace bvhio {
namespace {

constexpr size_t kTreeSize = 64;

/// What every form's tree has.
struct TreeParameters {
    uint32_t form = 0;
    uint64_t nodeSlots = 0, references = 0;
    SahCosts costs;
    uint32_t depth = 0;
};

uint32_t depthOf(const Bvh& bvh) {
    std::vector<uint8_t> depths(bvh.nodes.size() / 2);
    uint8_t deepest = 0;
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        const Node& node = bvh.nodes[i];
        if (i == 1 || node.isLeaf()) continue;
        const auto depth = uint8_t(depths[i / 2] + 1);
        depths[node.left() / 2] = depth;
        deepest = std::max(deepest, depth);
    }
    return deepest;
}

/// Checks a tree that was read, boxes as its form reconstructs them, against every rule of core/bvh.h. Its
/// nodes are records of `nodeSize` bytes from `nodesOffset` on.
void judgeTree(ChunkSequence& chunks, const Bvh& bvh, const TreeParameters& parameters, const Scene& scene,
               uint64_t nodesOffset, size_t nodeSize) {
    Validation validation =
        validate(bvh, uint32_t(scene.triangles.size()),
                 chunks.sound() ? boundsOfTriangles(scene) : PrimitiveBounds{}, chunks.maxPerId());
    for (Finding& finding : validation.findings) {
        finding.chunk = "NODE";
        if (finding.node != kNowhere) finding.offset = finding.node * nodeSize;
    }
    if (validation.findings.empty() && validation.depth != parameters.depth)
        chunks.fail(FindingId::statedDepth, "the tree has depth " + std::to_string(validation.depth) +
                                                ", TREE states " + std::to_string(parameters.depth));
    chunks.judge(std::move(validation.findings), nodesOffset);
}

/// How one form is stored: specialised for each.
template <class F>
struct FormChunks;

template <>
struct FormChunks<AabbForm> {
    static constexpr uint32_t kCode = chunkType("aabb");

    static TreeParameters parameters(const AabbForm& form) {
        return {kCode, form.bvh().nodes.size(), form.primitives().size(), {}, depthOf(form.bvh())};
    }
    static void write(ContainerWriter& writer, const AabbForm& form) {
        writeArrayChunk(writer, kNodesType, form.bvh().nodes);
        writeArrayChunk(writer, kPrimitivesType, form.bvh().primitives);
    }
    static AabbForm read(ChunkSequence& chunks, const TreeParameters& parameters, const Scene& scene) {
        Bvh bvh;
        bvh.nodes = chunks.expectArray<Node>(kNodesType, parameters.nodeSlots);
        const uint64_t nodesOffset = chunks.payloadOffset();
        bvh.primitives = chunks.expectArray<uint32_t>(kPrimitivesType, parameters.references);
        judgeTree(chunks, bvh, parameters, scene, nodesOffset, sizeof(Node));
        return AabbForm(std::move(bvh));
    }
};

template <>
struct FormChunks<SshForm> {
    static constexpr uint32_t kCode = chunkType("ssh ");
    static constexpr size_t kFormSize = 64;

    static TreeParameters parameters(const SshForm& form) {
        return {kCode, form.nodes().size(), form.primitives().size(), {}, depthOf(form.decode())};
    }
    static void write(ContainerWriter& writer, const SshForm& form) {
        ByteWriter bytes;
        for (const Vec3& corner : {form.bounds().min, form.bounds().max})
            for (int axis = 0; axis < 3; ++axis) bytes.f32(corner[axis]);
        bytes.zeros(kFormSize - bytes.bytes().size());
        writeChunk(writer, kFormType, bytes.bytes());
        writeArrayChunk(writer, kNodesType, form.nodes());
        writeArrayChunk(writer, kPrimitivesType, form.primitives());
    }
    static SshForm read(ChunkSequence& chunks, const TreeParameters& parameters, const Scene& scene) {
        if (parameters.references > SshNode::kMaxReferences)
            chunks.fail(FindingId::treeCounts, "an ssh tree has at most 2^25 references");
        const Bytes payload = chunks.expect(kFormType, kFormSize);
        ByteReader reader(payload, "chunk FORM");
        Aabb bounds;
        for (Vec3* corner : {&bounds.min, &bounds.max})
            for (int axis = 0; axis < 3; ++axis) (*corner)[axis] = reader.f32();
        if (!reader.skipZeros(reader.remaining()))
            chunks.fail(FindingId::payloadReserved, "a reserved field is not zero");
        SharedArray<SshNode> nodes = chunks.expectArray<SshNode>(kNodesType, parameters.nodeSlots);
        for (size_t i = 0; i < nodes.size(); ++i) checkNode(chunks, nodes, i);
        const uint64_t nodesOffset = chunks.payloadOffset();
        SshForm form(bounds, std::move(nodes),
                     chunks.expectArray<uint32_t>(kPrimitivesType, parameters.references));
        judgeTree(chunks, form.decode(), parameters, scene, nodesOffset, sizeof(SshNode));
        return form;
    }

  private:
    /// Whatever must hold before the tree can be decoded at all.
    static void checkNode(const ChunkSequence& chunks, std::span<const SshNode> nodes, size_t i) {
        const SshNode& node = nodes[i];
        if (i == 1) {
            if (std::bit_cast<uint64_t>(node) != 0)
                chunks.fail(FindingId::unusedSlot, "the unused slot 1 beside the root is not zero");
        } else if (node.side() > 5) {
            chunks.fail(FindingId::nodeField,
                        "node " + std::to_string(i) + " names side " + std::to_string(node.side()));
        } else if (!node.isLeaf() && (node.left() <= i || node.left() >= nodes.size())) {
            chunks.fail(FindingId::childIndex,
                        "node " + std::to_string(i) + " has its children at " + std::to_string(node.left()) +
                            ": not behind it and below " + std::to_string(nodes.size()));
        }
    }
};

TreeParameters readParameters(ChunkSequence& chunks, uint64_t triangles) {
    const Bytes payload = chunks.expect(kTreeType, kTreeSize);
    ByteReader reader(payload, "chunk TREE");
    TreeParameters p;
    p.form = reader.u32();
    bool zero = reader.skipZeros(4);
    p.nodeSlots = reader.u64();
    p.references = reader.u64();
    p.costs.traversal = reader.f32();
    p.costs.intersection = reader.f32();
    p.depth = reader.u32();
    zero &= reader.skipZeros(reader.remaining());
    if (!zero) chunks.fail(FindingId::payloadReserved, "a reserved field is not zero");
    if (p.references < triangles || p.references > 0xFFFFFFFF || p.nodeSlots < 2 || p.nodeSlots % 2 != 0 ||
        p.nodeSlots > 2 * p.references || p.nodeSlots > 0xFFFFFFFE || p.depth > kMaxDepth)
        chunks.fail(FindingId::treeCounts, std::to_string(p.nodeSlots) + " node slots and " +
                                               std::to_string(p.references) + " references of depth " +
                                               std::to_string(p.depth) + " are no tree over " +
                                               std::to_string(triangles) + " triangles");
    for (const float cost : {p.costs.traversal, p.costs.intersection})
        if (!std::isfinite(cost) || std::signbit(cost))
            chunks.fail(FindingId::treeCosts, "a SAH cost is negative or not finite");
    return p;
}

/// Reads the form that `parameters` names, out of the list of EncodedBvh.
template <size_t I = 0>
EncodedBvh readForm(ChunkSequence& chunks, const TreeParameters& parameters, const Scene& scene) {
    if constexpr (I == std::variant_size_v<EncodedBvh>) {
        chunks.fail(FindingId::unknownForm,
                    "unknown form '" + chunkTypeName(parameters.form) + "': use a newer bvhx");
    } else {
        using Chunks = FormChunks<std::variant_alternative_t<I, EncodedBvh>>;
        if (Chunks::kCode == parameters.form) return Chunks::read(chunks, parameters, scene);
        return readForm<I + 1>(chunks, parameters, scene);
    }
}

}  // namespace

void writeTree(ContainerWriter& writer, const EncodedBvh& bvh, const SahCosts& costs) {
    std::visit(
        [&](const auto& form) {
            using Chunks = FormChunks<std::decay_t<decltype(form)>>;
            const TreeParameters p = Chunks::parameters(form);
            ByteWriter bytes;
            bytes.u32(p.form);
            bytes.zeros(4);
            bytes.u64(p.nodeSlots);
            bytes.u64(p.references);
            bytes.f32(costs.traversal);
            bytes.f32(costs.intersection);
            bytes.u32(p.depth);
            bytes.zeros(kTreeSize - bytes.bytes().size());
            writeChunk(writer, kTreeType, bytes.bytes());
            Chunks::write(writer, form);
        },
        bvh);
}

EncodedBvh refitTo(const EncodedBvh& bvh, const Scene& scene) {
    return std::visit(
        [&](const auto& form) -> EncodedBvh {
            return std::decay_t<decltype(form)>::encode(scene, refit(form.decode(), boundsOfTriangles(scene)),
                                                        {});
        },
        bvh);
}

StoredTree readTree(ChunkSequence& chunks, const Scene& scene) {
    const TreeParameters parameters = readParameters(chunks, scene.triangles.size());
    return {readForm(chunks, parameters, scene), parameters.costs};
}

}  // namespace bvhio
