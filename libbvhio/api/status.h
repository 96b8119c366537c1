// Between the C API and the library: exceptions become a status and a text of the thread.
#pragma once

#include <string>

#include "api/bvhio.h"

namespace bvhio {

/// Keeps what went wrong, for bvhioLastError of this thread, and returns its status. For within a catch
/// block.
BvhioStatus recordException() noexcept;

/// Runs the body of a C function; whatever it throws becomes its status.
template <class Body>
BvhioStatus guarded(const Body& body) noexcept {
    try {
        body();
        return BVHIO_OK;
    } catch (...) {
        return recordException();
    }
}

/// Throws Error{usage} when a pointer is NULL; `name` is the parameter's.
void requirePointer(const void* pointer, const char* name);
/// Throws Error{usage} when there is no element `index` among `count`; `what` names one ("chunk").
void requireIndex(uint64_t index, uint64_t count, const char* what);

}  // namespace bvhio
