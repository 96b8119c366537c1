// bvh-relayout: orders a tree's nodes in memory; the SAH cost stays the same.
#include "common/pass.h"
#include "common/run_tool.h"
#include "common/unused_options.h"
#include "core/report.h"
#include "relayout/clusters.h"
#include "relayout/layouts.h"
#include "relayout/order_effect.h"

using namespace bvhio;

namespace {

const ToolInfo kTool = {
    "bvh-relayout",
    "Orders the nodes of a container's tree, and the primitives of its leaves, in memory.",
    "  bvh-relayout scene.bvhx --layout pack | bvh-compress --form quantized -o compact.bvhx\n",
};

/// The options of layouts. A value below its range was not given.
class LayoutChoice {
  public:
    explicit LayoutChoice(CommandLine& line) : line_(line) {
        const LayoutOptions defaults;
        line.choice("--layout", name_, namedValues(layouts()), "order of the nodes");
        line.choice("--probability", probability_, kProbabilities,
                    "probability that a ray enters a node (default area)");
        line.number(
            "--smoothing", smoothing_, 0, 1e6f,
            withDefault("random rays added for each recorded ray, for --probability visits", kSmoothing));
        line.number("--line-size", lineSize_, 16, 1u << 20,
                    withDefault("bytes of a cache line", defaults.lineSize));
        line.number("--record-bytes", recordBytes_, 4, 1u << 10,
                    withDefault("bytes of a pair of siblings in the form that bvh-compress will use",
                                defaults.recordBytes));
        line.number("--threshold", threshold_, 0, 1,
                    "least probability of a child that a treelet takes in (default 0.5)");
        line.number("--treelet-size", treeletSize_, 1, UINT32_MAX,
                    "most pairs of siblings in a treelet (default: no limit in tdfs, one line in tbfs)");
        line.number("--pointer-bits", pointerBits_, SlotMap::kMinPointerBits, SlotMap::kMaxPointerBits,
                    withDefault("bits of a reference within a cluster", defaults.pointerBits));
    }

    /// Whether weights are visits.
    bool byVisits() const { return probability_ == kProbabilities[1].name; }
    float smoothing() const { return smoothing_; }

    /// Returns the chosen layout and puts its options, given or default, into `options`. Throws Error{usage}
    /// for an option that the layout does not use.
    const Layout& choose(LayoutOptions& options) {
        const Layout& layout = bvhio::choose(layouts(), "layout", name_);
        refuseUnused(line_, "layout", layout,
                     {{"--probability", kUsesWeights},
                      {"--line-size", kUsesLines | kUsesLineSize},
                      {"--record-bytes", kUsesLines},
                      {"--threshold", kUsesThreshold},
                      {"--treelet-size", kUsesTreeletSize},
                      {"--pointer-bits", kUsesPointerBits}});
        if (probability_.empty() && (layout.function.uses & kUsesWeights) != 0)
            probability_ = kProbabilities[0].name;
        if (!byVisits() && smoothing_ >= 0)
            throw Error(ErrorKind::usage, "--smoothing: is only for --probability visits: leave it out");
        if (byVisits() && smoothing_ < 0) smoothing_ = kSmoothing;
        take(layout, kUsesLines | kUsesLineSize, lineSize_, options.lineSize, 0u);
        take(layout, kUsesLines, recordBytes_, options.recordBytes, 0u);
        take(layout, kUsesThreshold, threshold_, options.threshold, -1.0f);
        take(layout, kUsesTreeletSize, treeletSize_, options.treeletSize, 0u);
        take(layout, kUsesPointerBits, pointerBits_, options.pointerBits, 0u);
        return layout;
    }

  private:
    template <class T>
    static void take(const Layout& layout, uint32_t use, T& given, T& option, T none) {
        if ((layout.function.uses & use) == 0) return;
        if (given == none) given = option;
        option = given;
    }

    inline static const std::vector<NamedValue> kProbabilities = {
        {"area", "proportional to the area of its box"},
        {"visits", "from the visits that bvh-trace --record-visits counted"},
    };
    // The least at which a view from the other side loses at most 2% against areas.
    static constexpr float kSmoothing = 2;

    CommandLine& line_;
    std::string name_{layouts()[0].name}, probability_;
    uint32_t lineSize_ = 0, recordBytes_ = 0, treeletSize_ = 0, pointerBits_ = 0;
    float threshold_ = -1, smoothing_ = -1;
};

/// The report's part about the order and the clusters, over all trees.
class LayoutReport {
  public:
    void add(const Bvh& before, const LayoutResult& layout, const LayoutOptions& options) {
        effects_.push_back(effectOf(before, layout, options));
        lineBytes_ = options.lineSize;
        const SlotStats stats = statsOf(layout.slots);
        slots_.slots += stats.slots;
        slots_.records += stats.records;
        slots_.glue += stats.glue;
        slots_.empty += stats.empty;
        slots_.clusters += stats.clusters;
        pointerBits_ = std::max(pointerBits_, layout.slots.pointerBits);
    }
    Report report() const {
        Report report;
        report["order"] = order();
        if (slots_.records > 0) report["clusters"] = clusters();
        return report;
    }

  private:
    static constexpr double kSlotBytes = 8;

    Report order() const {
        const auto sum = [&](auto OrderEffect::*count) {
            uint64_t total = 0;
            for (const OrderEffect& effect : effects_) total += effect.*count;
            return total;
        };
        Report order = {{"pairs", sum(&OrderEffect::pairs)},       {"moved", sum(&OrderEffect::moved)},
                        {"record_bytes", effects_[0].recordBytes}, {"line_bytes", lineBytes_},
                        {"page_bytes", OrderEffect::kPageBytes},   {"lines", sum(&OrderEffect::lines)},
                        {"pages", sum(&OrderEffect::pages)}};
        // It is not known how often rays reach each of several trees.
        if (effects_.size() > 1) return order;
        const auto changes = [](const ExpectedChanges& of) {
            return Report{{"before", of.before}, {"after", of.after}};
        };
        order["line_changes"] = changes(effects_[0].lineChanges);
        order["page_changes"] = changes(effects_[0].pageChanges);
        return order;
    }
    Report clusters() const {
        return {{"records", slots_.records},
                {"clusters", slots_.clusters},
                {"glue_share", slots_.glueShare()},
                {"padding_share", slots_.paddingShare()},
                {"fill", slots_.fill(pointerBits_)},
                {"bytes_per_record", double(slots_.slots) * kSlotBytes / double(slots_.records)}};
    }

    std::vector<OrderEffect> effects_;  // of each tree
    SlotStats slots_;
    uint32_t lineBytes_ = 0, pointerBits_ = 0;
};

ExitCode relayout(CommandLine& line) {
    LayoutChoice choice(line);
    Pass pass(line, "INPUT", "container; - or nothing: standard input");
    LayoutOptions options;
    const Layout& layout = choice.choose(options);

    BvhxFile file = pass.read();
    if (choice.byVisits() && file.visits.empty())
        throw Error(
            ErrorKind::usage,
            "--probability visits: the container has no visits: record them with bvh-trace --record-visits");
    pass.stages().begin("relayout");
    std::vector<uint32_t> visits;
    LayoutReport report;
    changeTrees(file, [&](const Scene&, const Bvh& bvh, bool) {
        if (choice.byVisits()) options.weights = weightsByVisits(bvh, file.visits, choice.smoothing());
        const LayoutResult result = layout.function(bvh, options);
        if (!file.visits.empty()) visits = inNodeOrder(file.visits, result.order);
        if (pass.reports()) report.add(bvh, result, options);
        return applyLayout(bvh, result);
    });
    dropChunksThatDoNotSurvive(file, Change::reordered);
    if (!visits.empty()) file.visits = std::move(visits);
    pass.finish(file, {}, "relayout", pass.reports() ? report.report() : Report::object());
    return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
    return runTool(kTool, argc, argv, relayout);
}
