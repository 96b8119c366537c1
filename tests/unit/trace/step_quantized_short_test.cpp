#include "trace/step_quantized_short.h"

#include <gtest/gtest.h>

#include "unit/relayout/small_tree.h"

namespace bvhio {
namespace {

using namespace HWY_NAMESPACE;

/// Records where records are fetched.
struct FetchMetrics : NoMetrics {
    std::vector<size_t> offsets;
    void recordFetched(size_t offset, size_t bytes) {
        EXPECT_EQ(bytes, 8u);
        offsets.push_back(offset);
    }
};

// The cache model needs both fetches: the glue, and the record that it leads to.
TEST(StepQuantizedShort, tellsOfEachSlotThatIsFetched) {
    Bvh bvh = test::treeOfPairs({{0, 2}, {2, 4}, {4, 6}});
    bvh.slots = {2, 2, std::vector<uint32_t>{0, SlotMap::kGlue | 1, 1, 2}};
    const QuantizedShortForm form = QuantizedShortForm::encode({}, bvh, {});
    ASSERT_EQ(form.slots().size(), 4u);
    EXPECT_TRUE(form.slots()[1].isGlue());
    const Ray ray{{0.5f, 0.5f, -1}, 0, {0, 0, 1}, 10};
    const PreparedRay prepared(ray);
    const Stepper<QuantizedShortForm> stepper(form);
    const RayFrame frame = stepper.prepare(prepared);
    FetchMetrics metrics;
    Entered<Stepper<QuantizedShortForm>::Cursor> node, next, stack[3], *top = stack;
    ASSERT_TRUE(stepper.enterRoot(frame, 10, node, metrics));
    for (int depth = 1; depth <= 3; ++depth) {
        ASSERT_TRUE(stepper.step(node, frame, 10, next, top, metrics));
        EXPECT_EQ(top, stack + depth);
        node = next;
    }
    EXPECT_TRUE(stepper.isLeaf(node.cursor));
    EXPECT_EQ(metrics.offsets, (std::vector<size_t>{0, 8, 16, 24}));
}

}  // namespace
}  // namespace bvhio
