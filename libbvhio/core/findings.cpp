#include "core/findings.h"

namespace bvhio {

std::span<const FindingKind> findingKinds() {
    using enum FindingId;
    using enum ErrorKind;
    static constexpr FindingKind kTable[] = {
        {signature, invalid, "the file does not start with the signature"},
        {headerChecksum, invalid, "the header's checksum does not match"},
        {newerMajor, unsupported, "the major version is newer than the reader's"},
        {newerReader, unsupported, "the file requires a newer reader"},
        {versionOrder, invalid, "the version is 0, or older than the reader version that the file requires"},
        {headerReserved, invalid, "a reserved byte of the header is not zero"},
        {cut, invalid, "the file ends too early"},
        {chunkHeaderChecksum, invalid, "a chunk header's checksum does not match"},
        {chunkReserved, invalid, "a reserved field or flag of a chunk header is not zero"},
        {chunkType, invalid, "a chunk's type has a byte that is not a letter, a digit or a space"},
        {unknownCodec, unsupported, "a chunk's codec is unknown"},
        {chunkSizes, invalid, "a chunk's sizes contradict each other or exceed a limit"},
        {payloadChecksum, invalid, "a payload's checksum does not match"},
        {padding, invalid, "a padding byte is not zero"},
        {codecPayload, invalid, "a compressed payload does not decode"},
        {endForm, invalid, "the END chunk is malformed"},
        {endTotals, invalid, "END's chunk count or file size is wrong"},
        {contentHash, invalid, "the content hash does not match"},
        {trailingBytes, invalid, "bytes follow the END chunk"},

        {unknownCriticalChunk, unsupported, "a critical chunk's type is unknown"},
        {chunkExpected, invalid, "a chunk is missing or out of order"},
        {chunkRepeated, invalid, "a chunk appears twice"},
        {chunkFlags, invalid, "a chunk of known type has the wrong flags"},
        {chunkSize, invalid, "a payload's size does not match the counts"},
        {payloadReserved, invalid, "a reserved field of a payload is not zero"},
        {sceneCounts, invalid, "a count of the scene is out of range"},
        {unknownGeometryEncoding, unsupported, "the geometry's encoding is unknown"},
        {geometryRuns, invalid,
         "the geometries do not cover the triangles, or their names do not cover the bytes of names"},
        {unknownForm, unsupported, "the tree's form is unknown"},
        {treeCounts, invalid, "a count of the tree is out of range"},
        {treeCosts, invalid, "a SAH cost is negative or not finite"},
        {provenance, invalid, "the provenance is malformed"},
        {text, invalid, "a text is not well-formed UTF-8"},
        {draco, invalid, "the Draco geometry does not decode to the stated counts"},
        {topology, invalid, "the topology does not decode to a tree with the stated counts"},
        {meshRuns, invalid, "the meshes do not cover the geometries, or one has no triangles"},
        {instances, invalid,
         "an instance's mesh or geometry is out of range, or there are too many primitives"},
        {formParameter, invalid, "a parameter of the form is out of range"},
        {treeOfInstances, invalid, "the tree's form or the geometry's encoding does not support instances"},
        {visits, invalid, "a pair of nodes has more visits than the pair that holds its parent"},

        {unusedSlot, invalid, "the unused node slot beside the root is not zero"},
        {childIndex, invalid,
         "an inner node's children are out of range, at an odd index or not after the node"},
        {sharedChildren, invalid, "a pair of nodes has no parent, or several"},
        {leafRange, invalid, "a leaf's range is too long or exceeds the array of primitives"},
        {leafCover, invalid, "the leaves' ranges overlap or leave a gap"},
        {primitiveIndex, invalid, "an entry of the array of primitives is not the index of a triangle"},
        {missingPrimitive, invalid, "a triangle is in no leaf"},
        {depth, invalid, "the tree is too deep"},
        {statedDepth, invalid, "the tree's depth differs from the stated depth"},
        {nodeField, invalid, "a field of a node has an undefined value"},
        {slots, invalid, "the clusters do not match the tree"},

        {boxNotFinite, invalid, "a node's box is not finite or has min > max"},
        {childOutsideParent, invalid, "a child's box extends outside its parent's box"},
        {primitiveOutsideLeaf, invalid, "a triangle extends outside the box of its leaf"},
        {vertexNotFinite, invalid, "a vertex is not finite"},
        {negativeZero, invalid, "a vertex coordinate is -0"},
        {vertexIndex, invalid, "a triangle's vertex index is out of range"},
        {instanceTransform, invalid, "an instance's transform is not finite or cannot be inverted"},
        {degenerateTriangles, usage, "triangles have zero area"},
        {unusedVertices, usage, "vertices belong to no triangle"},
    };
    return kTable;
}

const FindingKind& findingKind(FindingId id) {
    for (const FindingKind& kind : findingKinds())
        if (kind.id == id) return kind;
    return findingKinds().front();
}

namespace {

std::string describe(const std::string& name, const Finding& finding) {
    std::string text = name;
    if (!finding.chunk.empty()) text += ": chunk " + finding.chunk;
    if (finding.offset != kNowhere)
        text += (finding.chunk.empty() ? ": byte " : " at byte ") + std::to_string(finding.offset);
    return text + ": " + finding.message + " [" + std::to_string(uint32_t(finding.id)) + "]";
}

}  // namespace

FindingError::FindingError(const std::string& name, Finding finding)
    : Error(findingKind(finding.id).error, describe(name, finding)), finding_(std::move(finding)) {}

}  // namespace bvhio
