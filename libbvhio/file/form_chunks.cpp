#include "file/form_chunks.h"

#include <cmath>
#include <type_traits>

#include "file/aabb_chunks.h"
#include "file/mvh_chunks.h"
#include "file/quantized_chunks.h"
#include "file/quantized_short_chunks.h"
#include "file/ssh_chunks.h"
#include "file/two_level_chunks.h"
#include "scene/triangle_bounds.h"
#include "tree/refit.h"

namespace bvhio {
namespace {

constexpr size_t kTreeSize = 64;

/// Returns whether a tree over the scene can have these counts.
bool countsFit(const TreeParameters& p, const Scene& scene) {
    return p.references >= scene.triangles.size() && p.references <= 0xFFFFFFFF && p.nodeSlots >= 2 &&
           p.nodeSlots % 2 == 0 && p.nodeSlots <= 2 * (p.references + scene.instances.size()) &&
           p.nodeSlots <= 0xFFFFFFFE && p.depth <= kMaxDepth;
}

std::string describeCounts(const TreeParameters& p, const Scene& scene) {
    return std::to_string(p.nodeSlots) + " node slots and " + std::to_string(p.references) +
           " references of depth " + std::to_string(p.depth) + " cannot form a tree over " +
           std::to_string(scene.triangles.size()) + " triangles";
}

TreeParameters readParameters(ChunkSequence& chunks, const Scene& scene) {
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
    if (!countsFit(p, scene)) chunks.fail(FindingId::treeCounts, describeCounts(p, scene));
    for (const float cost : {p.costs.traversal, p.costs.intersection})
        if (!std::isfinite(cost) || std::signbit(cost))
            chunks.fail(FindingId::treeCosts, "a SAH cost is negative or not finite");
    return p;
}

/// Reads a tree in the form with the code of `parameters`, one of the alternatives of EncodedBvh.
template <size_t I = 0>
EncodedBvh readForm(ChunkSequence& chunks, const TreeParameters& parameters, const Scene& scene) {
    if constexpr (I == std::variant_size_v<EncodedBvh>) {
        chunks.fail(FindingId::unknownForm,
                    "unknown form '" + chunkTypeName(parameters.form) + "': use a newer bvhx");
    } else {
        using Form = std::variant_alternative_t<I, EncodedBvh>;
        using Chunks = FormChunks<Form>;
        if (Chunks::kCode == parameters.form) {
            if (scene.isInstanced() && !Form::kTraits.holdsInstances)
                chunks.fail(FindingId::treeOfInstances,
                            "a scene with instances must have its tree in the two-level form");
            return Chunks::read(chunks, parameters, scene);
        }
        return readForm<I + 1>(chunks, parameters, scene);
    }
}

}  // namespace

void writeTree(ContainerWriter& writer, const EncodedBvh& bvh, const SahCosts& costs, const Scene& scene,
               NodeEncoding encoding) {
    std::visit(
        [&](const auto& form) {
            using Chunks = FormChunks<std::decay_t<decltype(form)>>;
            const TreeParameters p = Chunks::parameters(form);
            if (!countsFit(p, scene)) throw Error(ErrorKind::invalid, describeCounts(p, scene));
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
            if (encoding == NodeEncoding::plain) {
                Chunks::write(writer, form);
            } else if constexpr (requires { Chunks::writeTopology(writer, form, scene); }) {
                Chunks::writeTopology(writer, form, scene);
            } else {
                throw Error(ErrorKind::usage,
                            "the " + std::string(form.kName) +
                                " form can't be stored as topology: use form aabb or codec zstd");
            }
        },
        bvh);
}

EncodedBvh refitTo(const EncodedBvh& bvh, const Scene& scene) {
    return std::visit(
        [&](const auto& form) -> EncodedBvh {
            return std::decay_t<decltype(form)>::encode(scene, refit(form.decode(), boundsOfTriangles(scene)),
                                                        form.options());
        },
        bvh);
}

StoredTree readTree(ChunkSequence& chunks, const Scene& scene) {
    const TreeParameters parameters = readParameters(chunks, scene);
    return {readForm(chunks, parameters, scene), parameters.costs};
}

}  // namespace bvhio
