// bvhioBuild: builds trees over scenes.
#include "api/pass.h"
#include "api/scene.h"
#include "build/builders.h"
#include "build/instanced.h"
#include "build/spatial.h"
#include "file/change_trees.h"

namespace bvhio {
namespace {

EncodedBvh buildEncoded(const Scene& scene, const Builder& builder, const BuildOptions& options) {
    if (!scene.isInstanced()) return AabbForm(builder.function(scene, options));
    return TwoLevelForm::encodeInstances(scene, buildInstanced(scene, builder, options),
                                         TwoLevelForm::exactLevels());
}

}  // namespace
}  // namespace bvhio

using namespace bvhio;

extern "C" BvhioStatus bvhioBuild(const BvhioScene* scene, const char* const* options,
                                  const BvhioContext* context, BvhioContainer** result) {
    return runPass("build", scene, options, context, result, [&](OptionList& list, Progress& progress) {
        BuildOptions build;
        const Builder& builder = list.row("builder", builders());
        build.bins = list.number("bins", build.bins, 0, 256);
        build.maxLeafSize = list.number("max-leaf-size", build.maxLeafSize, 1, kMaxLeafSize);
        build.splitBudget = list.number("split-budget", build.splitBudget, 0, kMaxSplitBudget);
        build.costs.traversal = list.number("traversal-cost", build.costs.traversal, 0, 1e6f);
        build.costs.intersection = list.number("intersection-cost", build.costs.intersection, 0, 1e6f);
        list.refuseUnknown();
        list.refuseUnused("bins", "builder", builder, kUsesBins);
        list.refuseUnused("split-budget", "builder", builder, kUsesSplitBudget);
        build.progress = &progress;
        return std::make_shared<Content>(
            BvhxFile{scene->scene, buildEncoded(scene->scene, builder, build), build.costs, {}, {}});
    });
}
