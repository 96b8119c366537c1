#include "file/bvhx_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "container/container.h"
#include "core/parallel.h"
#include "file/check.h"
#include "file/chunks.h"
#include "file/content.h"
#include "file/scene_chunks.h"
#include "tree/validate.h"
#include "unit/file/support.h"

namespace bvhio {
namespace {

const WriteOptions kVariants[] = {{},
                                  {.codec = "zstd"},
                                  {.geometry = GeometryEncoding::draco},
                                  {.codec = "zstd", .geometry = GeometryEncoding::draco}};

/// The finding that stops a read.
FindingId verdict(const std::string& bytes) {
    try {
        readBvhx(asBytes(bytes), "test");
    } catch (const FindingError& error) {
        return error.finding().id;
    }
    ADD_FAILURE() << "was read";
    return {};
}

std::filesystem::path temporaryFile(const std::string& name, const std::string& bytes) {
    const auto path = std::filesystem::path(testing::TempDir()) / (std::to_string(::getpid()) + name);
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

TEST(BvhxFile, comesBackAsItWasWithEveryCodec) {
    for (const std::string codec : {"none", "zstd"}) {
        BvhxFile file = sampleFile();
        file.scene.sourcePrimitives = std::vector<uint32_t>(21, 5u);
        const std::string bytes = written(file, {.codec = codec});
        const BvhxFile back = readBvhx(asBytes(bytes), "test");
        expectSameContent(file, back);
        EXPECT_EQ(written(back, {.codec = codec}), bytes) << codec;
    }
}

// Vertices move, so boxes that were not refitted would let triangles stick out, and the reader would refuse
// its own file.
TEST(BvhxFile, dracoMovesVerticesAndBoxesTogetherAndKeepsTriangles) {
    for (const int bits : {4, 11, 20}) {
        const BvhxFile file = sampleFile(300);
        const BvhxFile back = readBvhx(
            asBytes(written(file, {.geometry = GeometryEncoding::draco, .dracoPositionBits = bits})), "test");
        expectSameArray<TriangleIndices>(file.scene.triangles, back.scene.triangles, "triangles");
        expectSameArray<uint32_t>(std::get<AabbForm>(file.bvh).primitives(),
                                  std::get<AabbForm>(back.bvh).primitives(), "primitives");
        EXPECT_EQ(file.scene.geometries, back.scene.geometries);
        double furthest = 0;
        for (size_t i = 0; i < file.scene.vertices.size(); ++i)
            furthest = std::max(furthest, double(length(file.scene.vertices[i] - back.scene.vertices[i])));
        EXPECT_GT(furthest, 0);
        EXPECT_LE(furthest, 4.0 / (1 << bits)) << bits;
    }
}

TEST(BvhxFile, isRefusedWhenCutAtAnyByte) {
    for (const WriteOptions& options : kVariants) {
        const std::string bytes = written(sampleFile(5), options);
        for (size_t size = 0; size < bytes.size(); ++size)
            ASSERT_EQ(verdict(bytes.substr(0, size)), FindingId::cut) << size << " of " << bytes.size();
    }
}

TEST(BvhxFile, isRefusedWithAnyBitFlipped) {
    for (const WriteOptions& options : kVariants) {
        std::string bytes = written(sampleFile(5), options);
        for (size_t i = 0; i < bytes.size(); ++i)
            for (int bit = 0; bit < 8; ++bit) {
                bytes[i] = char(bytes[i] ^ (1 << bit));
                EXPECT_THROW(readBvhx(asBytes(bytes), "test"), FindingError)
                    << "byte " << i << " bit " << bit;
                bytes[i] = char(bytes[i] ^ (1 << bit));
            }
    }
}

TEST(BvhxFile, comesThroughAPipeByteByByte) {
    const BvhxFile file = sampleFile(40);
    for (const WriteOptions& options : {kVariants[0], kVariants[1]}) {
        const std::string bytes = written(file, options);
        int ends[2];
        ASSERT_EQ(::pipe(ends), 0);
        std::thread writer([&] {
            for (const char c : bytes) EXPECT_EQ(::write(ends[1], &c, 1), 1);
            ::close(ends[1]);
        });
        const auto source = streamSource(ends[0], "pipe");
        ContainerReader container(*source);
        expectSameContent(file, readContent(container));
        writer.join();
        ::close(ends[0]);
    }
}

TEST(BvhxFile, mappedNodesAreUsedInPlaceAndOutliveTheFile) {
    const BvhxFile file = sampleFile(40);
    const auto path = temporaryFile("mapped.bvhx", written(file));
    const BvhxFile back = readBvhx(path);
    std::filesystem::remove(path);
    const auto* nodes = std::get<AabbForm>(back.bvh).bvh().nodes.data();
    EXPECT_EQ(reinterpret_cast<uintptr_t>(nodes) % 64, 0u);
    std::ifstream maps("/proc/self/maps");
    const std::string text{std::istreambuf_iterator<char>(maps), {}};
    EXPECT_NE(text.find("mapped.bvhx"), std::string::npos);
    expectSameContent(file, back);
}

TEST(BvhxFile, missingFilesAndFoldersAreIoErrors) {
    for (const char* path : {"/no/such/file.bvhx", "/"}) {
        try {
            readBvhx(std::filesystem::path(path));
            ADD_FAILURE() << path;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::io) << error.what();
        }
    }
}

TEST(BvhxFile, bytesDoNotDependOnThreads) {
    const BvhxFile file = sampleFile(60000);  // over a block of 1 MiB
    for (const WriteOptions& options : kVariants) {
        std::string one;
        {
            const ThreadLimit limit(1);
            one = written(file, options);
        }
        EXPECT_TRUE(one == written(file, options)) << options.codec;
    }
}

TEST(BvhxFile, payloadsOfManyBlocksComeBack) {
    const BvhxFile file = sampleFile(60000);
    expectSameContent(file, readBvhx(asBytes(written(file, {.codec = "zstd", .codecLevel = 1})), "test"));
}

// A reader refuses payloads that expand more than 32 times, so a writer must not make one.
TEST(BvhxFile, payloadsThatCompressTooWellComeBack) {
    BvhxFile file = sampleFile();
    file.unknownChunks = {{chunkType("zero"), 0, std::vector<std::byte>(100000)}};
    const std::string bytes = written(file, {.codec = "zstd"});
    EXPECT_LT(bytes.size(), 10000u);
    expectSameContent(file, readBvhx(asBytes(bytes), "test"));
}

TEST(BvhxFile, unknownChunksStayUntilAPassDoesWhatTheyDoNotSurvive) {
    BvhxFile file = sampleFile();
    for (const uint32_t flags :
         {0u, kSurvivesReorder, kSurvivesTopologyChange, kSurvivesReorder | kSurvivesTopologyChange})
        file.unknownChunks.push_back({chunkType("test"), flags, {std::byte(flags)}});
    BvhxFile reordered = readBvhx(asBytes(written(file)), "test"), changed = reordered;
    ASSERT_EQ(reordered.unknownChunks.size(), 4u);
    dropChunksThatDoNotSurvive(reordered, Change::reordered);
    dropChunksThatDoNotSurvive(changed, Change::topologyChanged);
    ASSERT_EQ(reordered.unknownChunks.size(), 2u);
    EXPECT_EQ(reordered.unknownChunks[0].flags, kSurvivesReorder);
    ASSERT_EQ(changed.unknownChunks.size(), 2u);
    EXPECT_EQ(changed.unknownChunks[0].flags, kSurvivesTopologyChange);
}

// A reader could not notice visits that belong to other nodes.
TEST(BvhxFile, visitsSurviveNoChange) {
    for (const Change change : {Change::reordered, Change::topologyChanged}) {
        BvhxFile file = sampleFile();
        file.visits = std::vector<uint32_t>(decode(file.bvh).nodes.size() / 2, 3);
        BvhxFile read = readBvhx(asBytes(written(file)), "test");
        expectSameContent(file, read);
        ASSERT_FALSE(read.visits.empty());
        dropChunksThatDoNotSurvive(read, change);
        EXPECT_TRUE(read.visits.empty());
        EXPECT_TRUE(readBvhx(asBytes(written(read)), "test").visits.empty());
    }
}

TEST(BvhxFile, namesThatAreNoTextBecomeText) {
    BvhxFile file = sampleFile();
    file.scene.geometries[0].name = "caf\xE9 \xF0\x9F\x8C\xB2 \xED\xA0\x80";
    const BvhxFile back = readBvhx(asBytes(written(file)), "test");
    EXPECT_EQ(back.scene.geometries[0].name,
              "caf\xEF\xBF\xBD \xF0\x9F\x8C\xB2 \xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
}

// A writer makes no file that a reader refuses. Scenes without geometries used to make files with finding
// 2007.
TEST(BvhxFile, scenesAndTreesThatNoReaderTakesAreNotWritten) {
    const auto expectRefused = [](const BvhxFile& file, const char* word) {
        std::ostringstream out;
        try {
            writeBvhx(out, file, {});
            ADD_FAILURE() << word;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::invalid);
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    };
    BvhxFile file = sampleFile();
    file.scene.geometries.clear();
    expectRefused(file, "no geometries");
    file = sampleFile();
    file.scene.vertices = std::vector<Vec3>{{0, 0, 0}};
    expectRefused(file, "vertex index beyond 0");
    file = sampleFile();
    file.scene = sampleScene(22);
    expectRefused(file, "21 references");
    file = sampleFile();
    file.bvh = AabbForm({});
    expectRefused(file, "0 node slots");
}

TEST(BvhxFile, codecAndLevelAreChecked) {
    EXPECT_THROW(written(sampleFile(), {.codec = "lzma"}), Error);
    EXPECT_THROW(written(sampleFile(), {.codec = "zstd", .codecLevel = 99}), Error);
}

TEST(BvhxFile, aFullDiskIsAnIoError) {
    std::ofstream full("/dev/full", std::ios::binary);
    try {
        writeBvhx(full, sampleFile(5000), {});
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::io);
    }
}

TEST(CheckFile, findsNothingInAGoodFileButWarnings) {
    EXPECT_TRUE(checkBytes(asBytes(written(sampleFile())), "test").empty());
    BvhxFile file = sampleFile(20);
    AlignedVector<Vec3> vertices(file.scene.vertices.begin(), file.scene.vertices.end());
    vertices.push_back({0, 0, 0});
    AlignedVector<TriangleIndices> triangles(file.scene.triangles.begin(), file.scene.triangles.end());
    triangles[7].v1 = triangles[7].v0;
    file.scene.vertices = std::move(vertices);
    file.scene.triangles = std::move(triangles);
    const auto findings = checkBytes(asBytes(written(file)), "test");
    ASSERT_EQ(findings.size(), 2u);
    EXPECT_EQ(findings[0].id, FindingId::degenerateTriangles);
    EXPECT_EQ(findings[0].severity, Finding::Severity::warning);
    EXPECT_EQ(findings[1].id, FindingId::unusedVertices);
}

// readBvhx stops at the first finding; --check shows all of them, with their place in the file.
TEST(CheckFile, findsSeveralThingsAtOnce) {
    BvhxFile file = sampleFile(100);
    const Bvh& bvh = std::get<AabbForm>(file.bvh).bvh();
    AlignedVector<Node> nodes(bvh.nodes.begin(), bvh.nodes.end());
    nodes[2].bounds.max.x = 50;
    for (Node& node : nodes)
        if (node.isLeaf()) node.bounds.max = node.bounds.min;
    file.bvh = AabbForm({std::move(nodes), bvh.primitives});
    const std::string bytes = written(file);
    const auto findings = checkBytes(asBytes(bytes), "test");
    EXPECT_EQ(std::count_if(findings.begin(), findings.end(),
                            [](const Finding& f) { return f.id == FindingId::primitiveOutsideLeaf; }),
              8);
    const auto outside = std::find_if(findings.begin(), findings.end(),
                                      [](const Finding& f) { return f.id == FindingId::childOutsideParent; });
    ASSERT_NE(outside, findings.end());
    EXPECT_EQ(outside->node, 2u);
    EXPECT_EQ(outside->chunk, "NODE");
    float x = 0;
    std::memcpy(&x, bytes.data() + outside->offset + offsetof(Node, bounds.max.x), sizeof x);
    EXPECT_EQ(x, 50);
}

TEST(ListChunks, listsAFileWithDamagedContent) {
    std::string bytes = written(sampleFile());
    const size_t vertices = bytes.find("VERT") + 64;
    bytes[vertices] = char(bytes[vertices] ^ 1);
    const auto path = temporaryFile("list.bvhx", bytes);
    const ChunkList list = listChunks(path);
    std::filesystem::remove(path);
    EXPECT_FALSE(list.stop);
    std::string types;
    for (const ListedChunk& chunk : list.chunks) {
        types += chunk.type + (chunk.checksumMatches ? " " : "! ");
        EXPECT_EQ(chunk.codec, "none");
        EXPECT_EQ(bytes.substr(chunk.header.offset, 4), chunk.type);
    }
    EXPECT_EQ(types, "SCEN VERT! TRIS GEOM TREE NODE PRIM PROV END  ");
}

}  // namespace
}  // namespace bvhio
