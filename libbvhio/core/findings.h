// The numbered findings about a file: one list for the readers, the validator, `bvh-stats --check` and
// format-spec/diagnostics.md.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/error.h"

namespace bvhio {

/// The families are 10xx container, 20xx chunks, 30xx structure of the tree, and 40xx geometry; x1xx are
/// warnings. Numbers are never reused.
enum class FindingId : uint32_t {
    signature = 1001,
    headerChecksum = 1002,
    newerMajor = 1003,
    newerReader = 1004,
    versionOrder = 1005,
    headerReserved = 1006,
    cut = 1010,
    chunkHeaderChecksum = 1011,
    chunkReserved = 1012,
    chunkType = 1013,
    unknownCodec = 1014,
    chunkSizes = 1015,
    payloadChecksum = 1016,
    padding = 1017,
    codecPayload = 1018,
    endForm = 1020,
    endTotals = 1021,
    contentHash = 1022,
    trailingBytes = 1023,

    unknownCriticalChunk = 2001,
    chunkExpected = 2002,
    chunkRepeated = 2003,
    chunkFlags = 2004,
    chunkSize = 2005,
    payloadReserved = 2006,
    sceneCounts = 2007,
    unknownGeometryEncoding = 2008,
    geometryRuns = 2009,
    unknownForm = 2010,
    treeCounts = 2011,
    treeCosts = 2012,
    provenance = 2013,
    text = 2014,
    draco = 2015,
    topology = 2016,
    meshRuns = 2017,
    instances = 2018,
    formParameter = 2019,
    treeOfInstances = 2020,
    visits = 2021,

    unusedSlot = 3001,
    childIndex = 3002,
    sharedChildren = 3003,
    leafRange = 3004,
    leafCover = 3005,
    primitiveIndex = 3006,
    missingPrimitive = 3007,
    depth = 3008,
    statedDepth = 3009,
    nodeField = 3010,
    slots = 3011,

    boxNotFinite = 4001,
    childOutsideParent = 4002,
    primitiveOutsideLeaf = 4003,
    vertexNotFinite = 4004,
    negativeZero = 4005,
    vertexIndex = 4006,
    instanceTransform = 4007,
    degenerateTriangles = 4101,
    unusedVertices = 4102,
};

/// A row of the list of findings.
struct FindingKind {
    FindingId id;
    ErrorKind error;  // of a reader that stops at this finding: invalid or unsupported; `usage` marks a
                      // warning, which stops no reader
    std::string_view summary;
};

/// Returns all kinds of findings, by ascending id.
std::span<const FindingKind> findingKinds();
const FindingKind& findingKind(FindingId id);

inline constexpr uint64_t kNowhere = ~uint64_t(0);

/// One fault of a file, and its place.
struct Finding {
    enum class Severity { warning, error };

    FindingId id;
    Severity severity;
    std::string message;         // one line
    std::string chunk;           // the chunk's type, "" for the file
    uint64_t offset = kNowhere;  // in the file, of the header or payload at fault
    uint64_t node = kNowhere;    // index of the node at fault
};

/// An Error that carries its finding; readers throw it.
class FindingError : public Error {
  public:
    /// Starts the message with `name`, the name of the file.
    FindingError(const std::string& name, Finding finding);
    const Finding& finding() const { return finding_; }

  private:
    Finding finding_;
};

}  // namespace bvhio
