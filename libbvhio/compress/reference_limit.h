// Forms with indices of few bits hold so many references and no more.
#pragma once

#include <string>
#include <string_view>

#include "core/error.h"

namespace bvhio {

/// Throws Error{unsupported} when a form that holds at most `limit` references is asked to hold more.
inline void refuseMoreThan(size_t limit, size_t references, std::string_view form) {
    if (references > limit)
        throw Error(ErrorKind::unsupported, "the " + std::string(form) + " form holds at most " +
                                                std::to_string(limit) + " references, not " +
                                                std::to_string(references) + ": use another --form");
}

}  // namespace bvhio
