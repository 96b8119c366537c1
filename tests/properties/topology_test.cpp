// Tests that every tree comes back from its topology bit by bit: nodes, their order, leaves' ranges and
// boxes.
#include <gtest/gtest.h>

#include "build/builders.h"
#include "common/shuffled_tree.h"
#include "common/test_scenes.h"
#include "relayout/layouts.h"
#include "unit/file/support.h"

namespace bvhio {
namespace {

class TopologyOfScene : public testing::TestWithParam<test::TestScene> {};

void expectComesBack(const Scene& scene, const Bvh& bvh) {
    const BvhxFile file{scene, AabbForm(bvh), {}, {}, {}};
    expectSameContent(file, readBvhx(asBytes(written(file, {.nodes = NodeEncoding::topology})), "test"));
}

TEST_P(TopologyOfScene, givesBackTreesAsBuilt) {
    const Scene scene = GetParam().make();
    for (const Builder& builder : builders())
        for (const uint32_t maxLeafSize : {1u, 4u, 300u}) {
            SCOPED_TRACE(testing::Message() << builder.name << " leaves of " << maxLeafSize);
            expectComesBack(scene, builder.function(scene, {.costs = {}, .maxLeafSize = maxLeafSize}));
        }
}

TEST_P(TopologyOfScene, givesBackTreesInAnyOrder) {
    const Scene scene = GetParam().make();
    for (const std::string_view builder : {"binned", "spatial"}) {
        const Bvh bvh = choose(builders(), "builder", builder).function(scene, {});
        for (const Layout& layout : layouts()) {
            SCOPED_TRACE(testing::Message() << builder << ' ' << layout.name);
            expectComesBack(scene, applyNodeOrder(bvh, layout.function(bvh, {}).order));
        }
        for (const bool swapChildren : {false, true}) {
            SCOPED_TRACE(testing::Message() << builder << " shuffled " << swapChildren);
            expectComesBack(scene, test::shuffledTree(bvh, 3, swapChildren));
        }
    }
}

// The boxes that forms reconstruct are larger than those of a refit, and the pairs of divided leaves come
// after all others.
TEST_P(TopologyOfScene, givesBackTreesThatFormsDecodeTo) {
    const Scene scene = GetParam().make();
    const Bvh bvh = builders().front().function(scene, {.costs = {}, .maxLeafSize = 13});
    for (const FormChoice& form : forms()) {
        SCOPED_TRACE(form.name);
        expectComesBack(scene, decode(form.function(scene, bvh, {})));
    }
}

INSTANTIATE_TEST_SUITE_P(Awkward, TopologyOfScene,
                         testing::ValuesIn(test::testScenes().begin(), test::testScenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace bvhio
