#include "api/pass.h"

#include <algorithm>
#include <mutex>

#include "core/parallel.h"

namespace bvhio {
namespace {

/// Reports progress to a callback, about kCalls times per pass and one call at a time, and ends the pass if
/// the callback asks for it.
class CallbackListener : public ProgressListener {
  public:
    CallbackListener(BvhioProgress callback, void* user) : callback_(callback), user_(user) {}

    void advanced(uint64_t done, uint64_t total) override {
        if (isCancelled_.load(std::memory_order_relaxed)) throw Cancelled();
        const uint64_t step = std::max<uint64_t>(total / kCalls, 1);
        const bool starts = done == 0, ends = total != 0 && done >= total;
        if (!starts && !ends && done < reported_.load(std::memory_order_relaxed) + step) return;
        std::unique_lock lock(mutex_, std::defer_lock);
        if (starts || ends)
            lock.lock();
        else if (!lock.try_lock())
            return;  // another thread reports
        if (!starts && done <= reported_.load(std::memory_order_relaxed)) return;
        reported_.store(done, std::memory_order_relaxed);
        if (callback_(user_, done, total) == 0) return;
        isCancelled_.store(true, std::memory_order_relaxed);
        throw Cancelled();
    }

  private:
    static constexpr uint64_t kCalls = 256;

    BvhioProgress callback_;
    void* user_;
    std::mutex mutex_;  // one call at a time
    std::atomic<uint64_t> reported_{0};
    std::atomic<bool> isCancelled_{false};
};

ProvenanceEntry historyEntry(std::string_view name, const OptionList& options, const BvhioContext& context) {
    Report recorded = {{"pass", name}};
    recorded.update(options.record());
    const bool isNamed = context.program != nullptr;
    const char* const version = context.programVersion != nullptr ? context.programVersion
                                : isNamed                         ? ""
                                                                  : bvhioVersionText();
    return {isNamed ? context.program : "libbvhio", version, jsonText(recorded)};
}

}  // namespace

BvhioStatus runPass(std::string_view name, const void* input, const char* const* options,
                    const BvhioContext* given, BvhioContainer** result, const PassBody& body) {
    return guarded([&] {
        requirePointer(result, "result");
        *result = nullptr;
        requirePointer(input, "the input");
        const BvhioContext context = given == nullptr ? BvhioContext{} : *given;
        OptionList list(options);
        CallbackListener listener(context.progress, context.progressUser);
        Progress progress;
        if (context.progress != nullptr) progress.listener = &listener;
        const ThreadLimit limit(context.threads);
        std::shared_ptr<Content> content = body(list, progress);
        content->file.provenance.push_back(historyEntry(name, list, context));
        *result = new BvhioContainer{std::move(content)};
    });
}

}  // namespace bvhio
