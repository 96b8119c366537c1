// The bytes of a glTF file's buffers and buffer views.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/shared_array.h"
#include "importers/gltf_document.h"

namespace bvhio {

/// Reads buffers when they are first needed: buffers that only textures use are never opened.
class GltfBuffers {
  public:
    /// `fileBytes` is the size of the glTF file itself.
    GltfBuffers(const GltfDocument& document, std::filesystem::path directory, size_t fileBytes)
        : document_(document),
          directory_(std::move(directory)),
          sourceBytes_(fileBytes),
          buffers_(document.buffers.size()) {}

    /// The bytes of a buffer view, decompressed when EXT_meshopt_compression says so. Throws Error invalid
    /// when it lies outside its buffer, io when the buffer cannot be read.
    std::span<const std::byte> view(int bufferView);

    /// Counts memory that the file makes the reader allocate. Throws Error resources when that is out of
    /// proportion to the size of the file and its buffers: a useful file needs at most 16 times that size
    /// (triangle strips with indices of one byte).
    void spend(uint64_t bytes);

    /// Counts bytes that Draco decodes; decodeDraco bounds what each byte may become. Throws Error resources
    /// when the file uses the same bytes again and again.
    void spendCompressed(uint64_t bytes);

    const std::string& name() const { return document_.name; }

  private:
    std::span<const std::byte> buffer(size_t number);
    AlignedVector<std::byte> load(const GltfBufferSource& source, const std::string& where) const;
    std::span<const std::byte> range(size_t buffer, size_t offset, size_t length, const std::string& where);
    AlignedVector<std::byte> decompress(const tinygltf::Value& extension, const std::string& where);

    const GltfDocument& document_;
    std::filesystem::path directory_;
    uint64_t sourceBytes_;
    uint64_t spentBytes_ = 0, decodedBytes_ = 0;
    std::vector<AlignedVector<std::byte>> buffers_;
    std::map<int, AlignedVector<std::byte>> decompressed_;
};

}  // namespace bvhio
