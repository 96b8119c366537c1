// bvhioRestructure: changes the topology of trees.
#include "api/pass.h"
#include "compress/exact_boxes.h"
#include "file/change_trees.h"
#include "restructure/restructurers.h"

using namespace bvhio;

extern "C" BvhioStatus bvhioRestructure(const BvhioContainer* container, const char* const* options,
                                        const BvhioContext* context, BvhioContainer** result) {
    return runPass(
        "restructure", container, options, context, result, [&](OptionList& list, Progress& progress) {
            RestructureOptions change;
            const Restructurer& method = list.row("method", restructurers());
            change.iterations = list.number("iterations", change.iterations, 0, 100000);
            change.treeletSize = list.number("treelet-size", change.treeletSize, 0, kMaxTreeletSize);
            change.gamma = list.number("gamma", change.gamma, 0, 1u << 30);
            change.collapse = list.flag("collapse", change.collapse);
            change.maxLeafSize = list.number("max-leaf-size", change.maxLeafSize, 0, kMaxLeafSize);
            list.refuseUnknown();
            list.refuseUnused("iterations", "method", method, kUsesIterations);
            list.refuseUnused("treelet-size", "method", method, kUsesTreelets);
            list.refuseUnused("gamma", "method", method, kUsesTreelets);
            list.refuseUnused("collapse", "method", method, kUsesLeaves);
            list.refuseUnused("max-leaf-size", "method", method, kUsesLeaves);
            if (!change.collapse) list.refuseUnused("max-leaf-size", "collapse=no");

            auto content = std::make_shared<Content>(contentOf(container).file);
            BvhxFile& file = content->file;
            change.costs = file.costs;
            change.progress = &progress;
            const bool isExact = traitsOf(file.bvh).isExact;
            changeTrees(file, [&](const Scene& scene, const Bvh& given, bool isTop) {
                // Costs are those of exact boxes, not of the larger boxes that a compact form made of them.
                RestructureOptions own = change;
                if (isTop) own.collapse = false;  // each instance has its own leaf
                return method.function(scene, isExact ? given : withExactBoxes(scene, given), own).bvh;
            });
            dropChunksThatDoNotSurvive(file, Change::topologyChanged);
            dropChunksThatDoNotSurvive(file, Change::reordered);
            return content;
        });
}
