#include "stats/size_stats.h"

#include <gtest/gtest.h>

#include "core/report.h"

namespace bvhio {
namespace {

TEST(SizeStats, addsUpWhatLiesInMemory) {
    const Scene scene{
        std::vector<Vec3>(4), std::vector<TriangleIndices>(2), {{"", 0, 2}}, std::vector<uint32_t>(2)};
    const Bvh bvh{std::vector<Node>(4), std::vector<uint32_t>{0, 1, 0}};
    const SizeStats stats = sizeStats(scene, AabbForm(bvh));
    EXPECT_EQ(stats.nodes, 4u * 32) << "the unused slot takes its bytes too";
    EXPECT_EQ(stats.primitives, 3u * 4);
    EXPECT_EQ(stats.geometry, 4u * 12 + 2 * 12 + 2 * 4);
    EXPECT_EQ(stats.nodeBytesPerPrimitive(), 64);
    EXPECT_EQ(stats.bytesPerPrimitive(), (128 + 12 + 80) / 2.0);

    Report report;
    addTo(report, stats);
    EXPECT_EQ(report.dump(),
              R"({"bytes":{"nodes":128,"primitives":12,"geometry":80},"bytes_per_primitive":64.0,)"
              R"("total_bytes_per_primitive":110.0})");
}

}  // namespace
}  // namespace bvhio
