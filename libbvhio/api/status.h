// Turns the library's exceptions into a status and a message for the thread.
#pragma once

#include <string>

#include "api/bvhio.h"

namespace bvhio {

/// Records the current exception for bvhioLastError on this thread, and returns its status. Call it in a
/// catch block.
BvhioStatus recordException() noexcept;

/// Runs the body of a C function, and returns its exception as a status.
template <class Body>
BvhioStatus guarded(const Body& body) noexcept {
    try {
        body();
        return BVHIO_OK;
    } catch (...) {
        return recordException();
    }
}

/// Throws Error{usage} if a pointer is NULL; `name` is the parameter's.
void requirePointer(const void* pointer, const char* name);
/// Throws Error{usage} unless `index` is below `count`; `what` is the word for an element, such as "chunk".
void requireIndex(uint64_t index, uint64_t count, const char* what);

}  // namespace bvhio
