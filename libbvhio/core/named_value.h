// A value of an option, for command lines and tables of options.
#pragma once

#include <string_view>

namespace bvhio {

/// One allowed value of an option and what it means.
struct NamedValue {
    std::string_view name, summary;
};

}  // namespace bvhio
