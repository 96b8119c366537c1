// A builder, then any number of restructurers, then a form:
// BUILDER[+METHOD[:ITERATIONS]]...[@FORM[:KEY=VALUE]...]
#pragma once

#include <optional>

#include "bench_common.h"
#include "build/builders.h"
#include "chain_form.h"
#include "restructure/restructurers.h"

namespace bvhio::bench {

class Chain {
  public:
    /// Throws Error{usage} for a name that is in no table.
    explicit Chain(const std::string& name) : name_(name) {
        const size_t at = std::min(name.find('@'), name.size());
        if (at < name.size()) form_ = formOfChain(name.substr(at + 1));
        const std::string text = name.substr(0, at);
        size_t end = std::min(text.find('+'), text.size());
        builder_ = &choose(builders(), "builder", text.substr(0, end));
        while (end < text.size()) {
            const size_t begin = end + 1;
            end = std::min(text.find('+', begin), text.size());
            const std::string step = text.substr(begin, end - begin);
            const size_t colon = std::min(step.find(':'), step.size());
            const int iterations = colon < step.size() ? std::atoi(step.c_str() + colon + 1) : 0;
            steps_.push_back(
                {&choose(restructurers(), "method", step.substr(0, colon)), uint32_t(iterations)});
        }
    }

    const std::string& name() const { return name_; }

    Bvh build(const Scene& scene, const SahCosts& costs) const {
        BuildOptions options;
        options.costs = costs;
        return builder_->function(scene, options);
    }

    Bvh restructure(const Scene& scene, Bvh bvh, const SahCosts& costs) const {
        RestructureOptions options;
        options.costs = costs;
        for (const Step& step : steps_) {
            options.iterations = step.iterations;
            bvh = step.restructurer->function(scene, bvh, options).bvh;
        }
        return bvh;
    }

    bool namesForm() const { return form_.has_value(); }
    EncodedBvh encode(const Scene& scene, const Bvh& bvh) const {
        return form_ ? form_->form->function(scene, bvh, form_->options)
                     : forms()[0].function(scene, bvh, {});
    }

  private:
    struct Step {
        const Restructurer* restructurer;
        uint32_t iterations;
    };
    std::string name_;
    const Builder* builder_;
    std::vector<Step> steps_;
    std::optional<ChainForm> form_;
};

}  // namespace bvhio::bench
