#include "file/topology.h"

#include <gtest/gtest.h>

#include "build/builders.h"
#include "common/shuffled_tree.h"
#include "core/parallel.h"
#include "file/check.h"
#include "unit/file/support.h"

namespace bvhio {
namespace {

const WriteOptions kTopology{.nodes = NodeEncoding::topology};

BvhxFile read(const std::string& bytes) {
    return readBvhx(asBytes(bytes), "test");
}

uint64_t topologyBytes(const std::string& bytes) {
    for (const ListedChunk& chunk : listChunks(asBytes(bytes), "test").chunks)
        if (chunk.type == "TOPO") return chunk.header.rawSize;
    return 0;
}

TEST(Topology, ofADepthFirstTreeIsABitANodeAndAByteALeaf) {
    BvhxFile file = sampleFile(1000);
    const uint64_t slots = std::get<AabbForm>(file.bvh).bvh().nodes.size();
    EXPECT_EQ(topologyBytes(written(file, kTopology)), 64 + (slots + 7) / 8 + slots / 2);
    file.bvh = AabbForm(builders().front().function(file.scene, {.costs = {}, .maxLeafSize = 1}));
    EXPECT_EQ(topologyBytes(written(file, kTopology)), 64 + (2000 + 7) / 8);
}

TEST(Topology, orderOfNodesCostsOnlyTreesThatHaveAnother) {
    BvhxFile file = sampleFile(1000);
    const uint64_t before = topologyBytes(written(file, kTopology));
    const uint64_t pairs = std::get<AabbForm>(file.bvh).bvh().nodes.size() / 2;
    file.bvh = AabbForm(test::shuffledTree(decode(file.bvh), 1, false));
    EXPECT_EQ(topologyBytes(written(file, kTopology)), before + 4 * (pairs - 1));
    file.bvh = AabbForm(test::shuffledTree(decode(file.bvh), 1, true));  // leaves' ranges stay
    EXPECT_EQ(topologyBytes(written(file, kTopology)), before + 4 * (pairs - 1) + 4 * pairs);
}

// Boxes may be larger than their content.
TEST(Topology, boxesThatARefitDoesNotGiveAreStored) {
    BvhxFile file = sampleFile(100);
    const Bvh bvh = decode(file.bvh);
    AlignedVector<Node> nodes(bvh.nodes.begin(), bvh.nodes.end());
    // A leaf grows, and its ancestors with it, which need not be stored. The root grows further.
    Node& leaf = *std::find_if(nodes.begin(), nodes.end(), [](const Node& n) { return n.isLeaf(); });
    leaf.bounds.max.x = 1e10f;
    for (size_t i = nodes.size(); i-- > 0;)
        if (i != 1 && !nodes[i].isLeaf())
            nodes[i].bounds = unite(nodes[nodes[i].left()].bounds, nodes[nodes[i].right()].bounds);
    nodes[0].bounds.max.y = nodes[0].bounds.max.z = 1e30f;
    const uint64_t plain = topologyBytes(written(file, kTopology));
    file.bvh = AabbForm({std::move(nodes), bvh.primitives});
    const std::string bytes = written(file, kTopology);
    EXPECT_EQ(topologyBytes(bytes), plain + (bvh.nodes.size() + 7) / 8 + 2 + 3 * sizeof(float));
    expectSameContent(file, read(bytes));
}

TEST(Topology, keepsNegativeZero) {
    Scene scene;
    scene.vertices = std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.triangles = std::vector<TriangleIndices>{{0, 1, 2}, {0, 1, 2}};
    scene.geometries = {{"", 0, 2}};
    for (const bool negativeLeft : {false, true}) {
        const Aabb plus{{0, 0, 0}, {1, 1, 0}}, minus{{-0.0f, 0, 0}, {1, 1, -0.0f}};
        AlignedVector<Node> nodes{{plus, 2, 0}, {}, {negativeLeft ? minus : plus, 0, 1}, {minus, 1, 1}};
        const BvhxFile file{scene, AabbForm({std::move(nodes), std::vector<uint32_t>{0, 1}}), {}, {}, {}};
        expectSameContent(file, read(written(file, kTopology)));
    }
}

// Vertices move, and a reader fits boxes to their new positions.
TEST(Topology, fitsBoxesToDracosVertices) {
    const BvhxFile file = sampleFile(300);
    WriteOptions options{.geometry = GeometryEncoding::draco, .dracoPositionBits = 11};
    const BvhxFile plain = read(written(file, options));
    options.nodes = NodeEncoding::topology;
    expectSameContent(plain, read(written(file, options)));
}

TEST(Topology, doesNotDependOnThreads) {
    const BvhxFile file = sampleFile(20000);  // its leaves are fitted in several stretches
    std::string one;
    {
        const ThreadLimit limit(1);
        one = written(file, kTopology);
        expectSameContent(file, read(one));
    }
    EXPECT_TRUE(one == written(file, kTopology));
    expectSameContent(file, read(one));
}

TEST(Topology, isRefusedForFormsWithBoxesOfTheirOwn) {
    BvhxFile file = sampleFile(30);
    file.bvh = choose(forms(), "form", "ssh").function(file.scene, decode(file.bvh), {});
    try {
        written(file, kTopology);
        ADD_FAILURE() << "was written";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    }
}

}  // namespace
}  // namespace bvhio
