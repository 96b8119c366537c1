#include "api/status.h"

#include <algorithm>
#include <cstring>
#include <new>

#include "core/findings.h"
#include "core/progress.h"

namespace bvhio {
namespace {

constexpr size_t kMaxMessage = 1000;

/// The last failure of a thread. Its memory is fixed, since the failure may be that there is no memory left.
struct Failure {
    char message[kMaxMessage + 1] = "";
    uint32_t finding = 0;
};
thread_local Failure lastFailure;

BvhioStatus fail(BvhioStatus status, const char* message, uint32_t finding = 0) noexcept {
    size_t length = std::min(std::strlen(message), kMaxMessage);
    // Do not cut within a UTF-8 character.
    while (length > 0 && (message[length] & 0xC0) == 0x80) --length;
    std::memcpy(lastFailure.message, message, length);
    lastFailure.message[length] = '\0';
    lastFailure.finding = finding;
    return status;
}

}  // namespace

BvhioStatus recordException() noexcept {
    try {
        throw;
    } catch (const FindingError& error) {
        return fail(BvhioStatus(error.kind()), error.what(), uint32_t(error.finding().id));
    } catch (const Error& error) {
        return fail(BvhioStatus(error.kind()), error.what());
    } catch (const Cancelled&) {
        return fail(BVHIO_CANCELLED, "cancelled by the progress callback");
    } catch (const std::bad_alloc&) {
        return fail(BVHIO_RESOURCES, "out of memory");
    } catch (const std::exception& error) {
        return fail(BVHIO_RESOURCES, error.what());  // such as a thread that the system does not grant
    } catch (...) {
        return fail(BVHIO_RESOURCES, "an exception of an unknown type");
    }
}

void requirePointer(const void* pointer, const char* name) {
    if (pointer == nullptr) throw Error(ErrorKind::usage, std::string(name) + " is NULL");
}

void requireIndex(uint64_t index, uint64_t count, const char* what) {
    if (index >= count)
        throw Error(ErrorKind::usage, std::string("there is no ") + what + " " + std::to_string(index) +
                                          ": there are " + std::to_string(count));
}

}  // namespace bvhio

static_assert(BVHIO_USAGE == int(bvhio::ErrorKind::usage) && BVHIO_IO == int(bvhio::ErrorKind::io) &&
              BVHIO_INVALID == int(bvhio::ErrorKind::invalid) &&
              BVHIO_RESOURCES == int(bvhio::ErrorKind::resources) &&
              BVHIO_UNSUPPORTED == int(bvhio::ErrorKind::unsupported));

extern "C" {

const char* bvhioLastError(void) {
    return bvhio::lastFailure.message;
}

uint32_t bvhioLastFinding(void) {
    return bvhio::lastFailure.finding;
}

const char* bvhioStatusName(BvhioStatus status) {
    switch (status) {
        case BVHIO_OK:
            return "ok";
        case BVHIO_USAGE:
            return "usage";
        case BVHIO_IO:
            return "io";
        case BVHIO_INVALID:
            return "invalid";
        case BVHIO_RESOURCES:
            return "resources";
        case BVHIO_UNSUPPORTED:
            return "unsupported";
        case BVHIO_CANCELLED:
            return "cancelled";
    }
    return "unknown";
}

uint32_t bvhioVersion(void) {
    return BVHIO_VERSION;
}

const char* bvhioVersionText(void) {
#define BVHIO_TEXT_OF(number) #number
#define BVHIO_TEXT(number) BVHIO_TEXT_OF(number)
    return BVHIO_TEXT(BVHIO_VERSION_MAJOR) "." BVHIO_TEXT(BVHIO_VERSION_MINOR) "." BVHIO_TEXT(
        BVHIO_VERSION_PATCH);
#undef BVHIO_TEXT
#undef BVHIO_TEXT_OF
}
}
