// The content that the handles of containers and tracers share.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "api/bvhio.h"
#include "container/container.h"
#include "file/bvhx_file.h"

namespace bvhio {

/// A container's content. Immutable once it is in a handle, except for trees, which are decoded on demand.
struct Content {
    explicit Content(BvhxFile content) : file(std::move(content)) {}

    BvhxFile file;
    WriteOptions writing{};             // for bvhioSaveFile and bvhioSaveMemory
    std::vector<ChunkHeader> chunks{};  // of the file that was opened
    uint64_t contentHash = 0;           // of the file that was opened

    /// Returns the trees as bvhioGetTree numbers them. May be called from any thread.
    const std::vector<Bvh>& trees() const;

  private:
    mutable std::once_flag decoded_;
    mutable std::vector<Bvh> trees_;
};

}  // namespace bvhio

struct BvhioContainer {
    std::shared_ptr<const bvhio::Content> content;
};

namespace bvhio {

inline const Content& contentOf(const BvhioContainer* container) {
    return *container->content;
}

}  // namespace bvhio
