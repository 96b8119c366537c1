// Prints metrics.csv: numbers of every builder's tree over every test scene, and of every restructurer's over
// the default builder's, that are the same on any machine.
// A change of code that moves one shows in the review of that file.
#include <cstdio>

#include "build/builders.h"
#include "common/test_scenes.h"
#include "rays/ray_sets.h"
#include "restructure/restructurers.h"
#include "stats/hashes.h"
#include "stats/size_stats.h"
#include "stats/stats_report.h"
#include "stats/tree_stats.h"
#include "trace/trace.h"

namespace bvhio {
namespace {

void printRow(const test::TestScene& row, const Scene& scene, const Builder& builder,
              const Restructurer& restructurer) {
    const Bvh bvh = restructurer.function(scene, builder.function(scene, {}), {}).bvh;
    const EncodedBvh encoded = AabbForm(bvh);
    const TreeStats tree = treeStats(bvh, {});

    const Tracer tracer(scene, encoded, TriangleSource::indexed);
    const ClosestHits closestHits = [&](std::span<const Ray> rays) {
        std::vector<Hit> hits(rays.size());
        tracer.closestHits(rays, hits);
        return hits;
    };
    RaySetOptions options;
    options.count = 4096;
    const RaySet raySet = makeRaySet("random", scene, options, closestHits);
    const TraversalCounts counts = tracer.measure(raySet.rays, QueryKind::closest).counts;

    // Six digits: sums in double are of a fixed order, so even the last bits repeat, but nobody wants to
    // review them.
    std::printf("%s,%s,%s,%zu,%zu,%zu,%u,%.6g,%.6g,%.6g,%zu,%zu,%.6g,%.6g,%.6g,%s\n", row.name,
                builder.name.data(), restructurer.name.data(), scene.triangles.size(), size_t(tree.nodes),
                size_t(tree.leaves), tree.maxDepth, tree.sahCost, epo(scene, bvh, {}).value,
                tree.childOverlap, size_t(sizeStats(scene, encoded).nodes), size_t(counts.hits), counts.nc(),
                counts.lc(), counts.tc(), hashText(boundsHash(bvh)).c_str());
}

}  // namespace
}  // namespace bvhio

int main() {
    std::puts(
        "scene,builder,restructurer,triangles,nodes,leaves,max_depth,sah_cost,epo,child_overlap,node_bytes,"
        "hits,NC,LC,TC,"
        "bounds_hash");
    using namespace bvhio;
    const Restructurer& none = choose(restructurers(), "method", "none");
    for (const test::TestScene& row : test::testScenes()) {
        const Scene scene = row.make();
        for (const Builder& builder : builders()) printRow(row, scene, builder, none);
        for (const Restructurer& restructurer : restructurers())
            if (restructurer.name != none.name) printRow(row, scene, builders()[0], restructurer);
    }
}
