// The names and summaries of methods that passes use.
#include "api/bvhio.h"
#include "build/builders.h"
#include "compress/forms.h"
#include "container/codecs.h"
#include "relayout/layouts.h"
#include "restructure/restructurers.h"

namespace bvhio {
namespace {

/// Calls use(table) with the table of a kind. Returns `otherwise` for a kind that does not exist.
template <class Result, class Use>
Result useTable(BvhioMethod kind, Result otherwise, const Use& use) {
    switch (kind) {
        case BVHIO_BUILDER:
            return use(builders());
        case BVHIO_RESTRUCTURER:
            return use(restructurers());
        case BVHIO_LAYOUT:
            return use(layouts());
        case BVHIO_FORM:
            return use(forms());
        case BVHIO_CODEC:
            return use(codecs());
    }
    return otherwise;
}

}  // namespace
}  // namespace bvhio

using namespace bvhio;

extern "C" {

uint64_t bvhioMethodCount(BvhioMethod kind) {
    return useTable(kind, uint64_t(0), [](const auto& table) { return uint64_t(table.size()); });
}

// Names and summaries are literals, which end with a zero byte.
const char* bvhioMethodName(BvhioMethod kind, uint64_t index) {
    return useTable<const char*>(kind, nullptr, [&](const auto& table) {
        return index < table.size() ? table[size_t(index)].name.data() : nullptr;
    });
}

const char* bvhioMethodSummary(BvhioMethod kind, uint64_t index) {
    return useTable<const char*>(kind, nullptr, [&](const auto& table) {
        return index < table.size() ? table[size_t(index)].summary.data() : nullptr;
    });
}
}
