// The content of a container, for readers: its counts, chunks, parts, arrays and trees.
#include <cstddef>
#include <cstring>

#include "api/content.h"
#include "api/status.h"

static_assert(sizeof(BvhioNode) == sizeof(bvhio::Node) &&
              offsetof(BvhioNode, min) == offsetof(bvhio::Node, bounds.min) &&
              offsetof(BvhioNode, max) == offsetof(bvhio::Node, bounds.max) &&
              offsetof(BvhioNode, first) == offsetof(bvhio::Node, first) &&
              offsetof(BvhioNode, count) == offsetof(bvhio::Node, primitiveCount));
static_assert(BVHIO_MAX_DEPTH == bvhio::kMaxDepth);
static_assert(sizeof(BvhioInstance::objectToWorld) == sizeof(bvhio::Affine));
static_assert(BVHIO_NOTHING == bvhio::kNoPrimitive);

namespace bvhio {
namespace {

/// Checks the pointers, and calls fill(content, *result).
template <class Result, class Fill>
BvhioStatus fillFrom(const BvhioContainer* container, Result* result, const char* name, const Fill& fill) {
    return guarded([&] {
        requirePointer(container, "container");
        requirePointer(result, name);
        fill(contentOf(container), *result);
    });
}

/// Checks the pointers and the index, and fills *result from one element of an array.
template <class Result, class Elements, class Fill>
BvhioStatus fillElement(const BvhioContainer* container, uint64_t index, Result* result, const char* name,
                        const Elements& elements, const Fill& fill) {
    return fillFrom(container, result, name, [&](const Content& content, Result& filled) {
        const auto& array = elements(content);
        requireIndex(index, array.size(), name);
        filled = fill(content, array[size_t(index)]);
    });
}

/// Returns an array of T, which the caller sees as an array of Element.
template <class Element, class T>
BvhioStatus giveArray(const BvhioContainer* container, const Element** elements, uint64_t* count,
                      SharedArray<T> Scene::*array) {
    return fillFrom(container, elements, "array", [&](const Content& content, const Element*& given) {
        requirePointer(count, "count");
        const SharedArray<T>& values = content.file.scene.*array;
        given = values.empty() ? nullptr : reinterpret_cast<const Element*>(values.data());
        *count = values.size();
    });
}

}  // namespace
}  // namespace bvhio

using namespace bvhio;

extern "C" {

BvhioStatus bvhioGetInfo(const BvhioContainer* container, BvhioInfo* info) {
    return fillFrom(container, info, "info", [](const Content& content, BvhioInfo& filled) {
        const Scene& scene = content.file.scene;
        filled = {};
        filled.vertexCount = scene.vertices.size();
        filled.triangleCount = scene.triangles.size();
        filled.geometryCount = scene.geometries.size();
        filled.meshCount = scene.meshes.size();
        filled.instanceCount = scene.instances.size();
        filled.primitiveCount = scene.primitiveCount();
        filled.treeCount = 1 + scene.meshes.size();
        filled.nodeBytes = std::visit([](const auto& form) { return form.nodeBytes(); }, content.file.bvh);
        filled.contentHash = content.contentHash;
        filled.form = formNameOf(content.file.bvh).data();
        filled.traversalCost = content.file.costs.traversal;
        filled.intersectionCost = content.file.costs.intersection;
        filled.chunkCount = uint32_t(content.chunks.size());
        filled.historyCount = uint32_t(content.file.provenance.size());
    });
}

BvhioStatus bvhioGetChunk(const BvhioContainer* container, uint64_t index, BvhioChunk* chunk) {
    return fillElement(
        container, index, chunk, "chunk", [](const Content& content) { return std::span(content.chunks); },
        [](const Content&, const ChunkHeader& header) {
            BvhioChunk filled{};
            std::memcpy(filled.type, &header.type, sizeof header.type);
            filled.flags = header.flags;
            filled.codec = findCodec(header.codec)->name.data();
            filled.rawSize = header.rawSize;
            filled.storedSize = header.storedSize;
            filled.offset = header.offset;
            return filled;
        });
}

BvhioStatus bvhioGetGeometry(const BvhioContainer* container, uint64_t index, BvhioGeometry* geometry) {
    return fillElement(
        container, index, geometry, "geometry",
        [](const Content& content) { return std::span(content.file.scene.geometries); },
        [](const Content&, const Geometry& from) {
            return BvhioGeometry{from.name.c_str(), from.firstTriangle, from.triangleCount};
        });
}

BvhioStatus bvhioGetMesh(const BvhioContainer* container, uint64_t index, BvhioMesh* mesh) {
    return fillElement(
        container, index, mesh, "mesh",
        [](const Content& content) { return std::span(content.file.scene.meshes); },
        [](const Content&, const SceneMesh& from) {
            return BvhioMesh{from.firstGeometry, from.geometryCount, from.firstTriangle, from.triangleCount};
        });
}

BvhioStatus bvhioGetInstance(const BvhioContainer* container, uint64_t index, BvhioInstance* instance) {
    return fillElement(
        container, index, instance, "instance",
        [](const Content& content) { return std::span(content.file.scene.instances); },
        [](const Content&, const SceneInstance& from) {
            BvhioInstance filled{};
            std::memcpy(filled.objectToWorld, from.objectToWorld.data(), sizeof filled.objectToWorld);
            filled.mesh = from.mesh;
            filled.firstPrimitive = from.firstPrimitive;
            filled.firstGeometry = from.firstGeometry;
            return filled;
        });
}

BvhioStatus bvhioGetHistory(const BvhioContainer* container, uint64_t index, BvhioHistory* history) {
    return fillElement(
        container, index, history, "history entry",
        [](const Content& content) { return std::span(content.file.provenance); },
        [](const Content&, const ProvenanceEntry& from) {
            return BvhioHistory{from.tool.c_str(), from.version.c_str(), from.options.c_str()};
        });
}

BvhioStatus bvhioGetVertices(const BvhioContainer* container, const float** xyz, uint64_t* count) {
    return giveArray(container, xyz, count, &Scene::vertices);
}

BvhioStatus bvhioGetTriangles(const BvhioContainer* container, const uint32_t** indices, uint64_t* count) {
    return giveArray(container, indices, count, &Scene::triangles);
}

BvhioStatus bvhioGetSourceIds(const BvhioContainer* container, const uint32_t** ids, uint64_t* count) {
    return giveArray(container, ids, count, &Scene::sourcePrimitives);
}

BvhioStatus bvhioGetTree(const BvhioContainer* container, uint64_t index, BvhioTree* tree) {
    return fillElement(
        container, index, tree, "tree", [](const Content& content) { return std::span(content.trees()); },
        [](const Content&, const Bvh& bvh) {
            return BvhioTree{reinterpret_cast<const BvhioNode*>(bvh.nodes.data()), bvh.nodes.size(),
                             bvh.primitives.data(), bvh.primitives.size()};
        });
}

BvhioStatus bvhioGetPrimitive(const BvhioContainer* container, uint32_t number, BvhioPrimitive* primitive) {
    return fillFrom(container, primitive, "primitive", [&](const Content& content, BvhioPrimitive& filled) {
        const Scene& scene = content.file.scene;
        requireIndex(number, scene.primitiveCount(), "primitive");
        const Scene::PrimitiveId id = scene.primitiveId(number);
        const Triangle corners = scene.placedTriangle(number);
        filled = {};
        filled.geometry = id.geometry;
        filled.sourceId = id.primitive;
        filled.instance = id.instance;
        filled.triangle = scene.triangleOf(number);
        static_assert(sizeof corners == sizeof filled.corners);
        std::memcpy(filled.corners, &corners, sizeof corners);
    });
}
}
