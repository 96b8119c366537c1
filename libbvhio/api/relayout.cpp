// bvhioRelayout: orders nodes in memory.
#include "api/pass.h"
#include "file/change_trees.h"
#include "relayout/clusters.h"
#include "relayout/layouts.h"

namespace bvhio {
namespace {

constexpr std::string_view kProbabilityNames[] = {"area", "visits"};
// The number of random rays that count beside each recorded ray: the least at which a view from the other
// side loses at most 2% against areas.
constexpr float kStandardSmoothing = 2;

/// Reads an option that only some layouts use. The record of other layouts leaves it out.
template <class Number>
void askFor(OptionList& list, const Layout& layout, uint32_t uses, const char* name, Number& value,
            Number standard, Number min, Number max) {
    const Number asked = list.number(name, standard, min, max);
    list.refuseUnused(name, "layout", layout, uses);
    if ((layout.function.uses & uses) != 0)
        value = asked;
    else
        list.forget(name);
}

}  // namespace
}  // namespace bvhio

using namespace bvhio;

extern "C" BvhioStatus bvhioRelayout(const BvhioContainer* container, const char* const* options,
                                     const BvhioContext* context, BvhioContainer** result) {
    return runPass(
        "relayout", container, options, context, result, [&](OptionList& list, Progress& progress) {
            LayoutOptions order;
            const Layout& layout = list.row("layout", layouts());
            const bool byVisits =
                list.choice("probability", kProbabilityNames[0], kProbabilityNames) == kProbabilityNames[1];
            const float smoothing = list.number("smoothing", kStandardSmoothing, 0, 1e6f);
            askFor(list, layout, kUsesLines | kUsesLineSize, "line-size", order.lineSize, order.lineSize, 16u,
                   1u << 20);
            askFor(list, layout, kUsesLines, "record-bytes", order.recordBytes, order.recordBytes, 4u,
                   1u << 10);
            askFor(list, layout, kUsesThreshold, "threshold", order.threshold, order.threshold, 0.0f, 1.0f);
            askFor(list, layout, kUsesTreeletSize, "treelet-size", order.treeletSize, order.treeletSize, 1u,
                   UINT32_MAX);
            askFor(list, layout, kUsesPointerBits, "pointer-bits", order.pointerBits, order.pointerBits,
                   SlotMap::kMinPointerBits, SlotMap::kMaxPointerBits);
            list.refuseUnknown();
            list.refuseUnused("probability", "layout", layout, kUsesWeights);
            if (!byVisits) {
                list.refuseUnused("smoothing", "probability=area");
                list.forget("smoothing");
            }

            auto content = std::make_shared<Content>(contentOf(container).file);
            BvhxFile& file = content->file;
            if (byVisits && file.visits.empty())
                throw Error(ErrorKind::usage,
                            "option probability: the container has no visits: bvh-trace --record-visits "
                            "records them");
            progress.start(1 + file.scene.meshes.size());
            std::vector<uint32_t> visits;
            changeTrees(file, [&](const Scene&, const Bvh& bvh, bool) {
                if (byVisits) order.weights = weightsByVisits(bvh, file.visits, smoothing);
                const LayoutResult changed = layout.function(bvh, order);
                if (!file.visits.empty()) visits = inNodeOrder(file.visits, changed.order);
                progress.add(1);
                return applyLayout(bvh, changed);
            });
            dropChunksThatDoNotSurvive(file, Change::reordered);
            if (!visits.empty()) file.visits = std::move(visits);
            return content;
        });
}
