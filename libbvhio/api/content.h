// What the handles of containers and tracers share.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "api/bvhio.h"
#include "container/container.h"
#include "file/bvhx_file.h"

namespace bvhio {

/// A container's content. Immutable once it is in a handle, but for the trees that are decoded on demand.
struct Content {
    explicit Content(BvhxFile content) : file(std::move(content)) {}

    BvhxFile file;
    WriteOptions writing{};             // how a save stores it
    std::vector<ChunkHeader> chunks{};  // of the file that was opened
    uint64_t contentHash = 0;           // of that file

    /// The trees as bvhioGetTree numbers them. From any thread.
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
