// The frame of every pass of the C API: options, threads, progress, history.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "api/content.h"
#include "api/option_list.h"
#include "api/status.h"
#include "core/progress.h"

namespace bvhio {

/// Makes the content of a pass's result. It reads its options, calls options.refuseUnknown() and then works.
using PassBody = std::function<std::shared_ptr<Content>(OptionList& options, Progress& progress)>;

/// Runs a pass, which histories call `name`. The other parameters are those of its C function.
BvhioStatus runPass(std::string_view name, const void* input, const char* const* options,
                    const BvhioContext* context, BvhioContainer** result, const PassBody& body);

}  // namespace bvhio
