// Opens and checks containers, for readers.
#include "api/content.h"
#include "api/status.h"
#include "core/parallel.h"
#include "file/check.h"
#include "file/chunks.h"
#include "file/content.h"

namespace bvhio {
namespace {

size_t threadsOf(const BvhioContext* context) {
    return context == nullptr ? 0 : context->threads;
}

/// Makes a handle from the source of bytes that `open()` returns.
template <class Open>
BvhioStatus openFrom(uint32_t flags, const BvhioContext* context, BvhioContainer** container,
                     const Open& open) {
    return guarded([&] {
        requirePointer(container, "container");
        *container = nullptr;
        if ((flags & ~BVHIO_TRUSTED) != 0)
            throw Error(ErrorKind::usage,
                        "unknown flags " + std::to_string(flags) + ": use 0 or BVHIO_TRUSTED");
        const ThreadLimit limit(threadsOf(context));
        const std::unique_ptr<ByteSource> source = open();
        ContainerReader reader(*source, (flags & BVHIO_TRUSTED) != 0 ? Trust::trusted : Trust::checked);
        auto content = std::make_shared<Content>(readContent(reader));
        content->chunks = reader.headers();
        content->contentHash = reader.contentHash();
        *container = new BvhioContainer{std::move(content)};
    });
}

std::span<const std::byte> spanOf(const void* bytes, size_t size) {
    return {static_cast<const std::byte*>(bytes), size};
}

constexpr const char* kMemoryName = "memory";

template <class Check>
BvhioStatus reportFindings(const BvhioContext* context, BvhioFindingCallback found, void* user,
                           const Check& check) {
    return guarded([&] {
        requirePointer(reinterpret_cast<const void*>(found), "found");
        const ThreadLimit limit(threadsOf(context));
        for (const Finding& finding : check())
            found(user, uint32_t(finding.id), finding.severity == Finding::Severity::error,
                  finding.message.c_str(), finding.chunk.c_str(), finding.offset, finding.node);
    });
}

}  // namespace
}  // namespace bvhio

using namespace bvhio;

extern "C" {

BvhioStatus bvhioOpenFile(const char* path, uint32_t flags, const BvhioContext* context,
                          BvhioContainer** container) {
    return openFrom(flags, context, container, [&] {
        requirePointer(path, "path");
        return openSource(path);
    });
}

BvhioStatus bvhioOpenFileRange(const char* path, uint64_t offset, uint64_t length, uint32_t flags,
                               const BvhioContext* context, BvhioContainer** container) {
    return openFrom(flags, context, container, [&] {
        requirePointer(path, "path");
        return openSource(path, offset, length);
    });
}

BvhioStatus bvhioOpenMemory(const void* bytes, size_t size, uint32_t flags, const BvhioContext* context,
                            BvhioContainer** container) {
    return openFrom(flags, context, container, [&] {
        requirePointer(bytes, "bytes");
        return viewSource(spanOf(bytes, size), kMemoryName);
    });
}

void bvhioClose(BvhioContainer* container) {
    delete container;
}

BvhioStatus bvhioCheckFile(const char* path, const BvhioContext* context, BvhioFindingCallback found,
                           void* user) {
    return reportFindings(context, found, user, [&] {
        requirePointer(path, "path");
        return checkFile(path);
    });
}

BvhioStatus bvhioCheckMemory(const void* bytes, size_t size, const BvhioContext* context,
                             BvhioFindingCallback found, void* user) {
    return reportFindings(context, found, user, [&] {
        requirePointer(bytes, "bytes");
        return checkBytes(spanOf(bytes, size), kMemoryName);
    });
}
}
