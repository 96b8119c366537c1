#include "importers/gltf_buffers.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "core/error.h"
#include "importers/read_file.h"

namespace bvhio {

namespace {

constexpr uint64_t kFreeBytes = 16 << 20;
constexpr uint64_t kMaxGrowth = 64;
constexpr uint64_t kMaxDecodes = 8;  // on average over the file; useful files need one
// meshoptimizer's vertex codec spends at least 4 bytes on 256 bytes of vertices, its index codecs a byte per
// triangle or index.
constexpr uint64_t kMaxMeshoptGrowth = 64;

[[noreturn]] void fail(const std::string& where, const std::string& what) {
    throw Error(ErrorKind::invalid, where + ": " + what);
}

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// Replaces "%20" and its like.
std::string percentDecoded(const std::string& uri) {
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && hexDigit(uri[i + 1]) >= 0 && hexDigit(uri[i + 2]) >= 0) {
            text += char(16 * hexDigit(uri[i + 1]) + hexDigit(uri[i + 2]));
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

/// A whole number from an extension's JSON.
size_t sizeMember(const tinygltf::Value& object, const char* key, const std::string& where,
                  bool required = true) {
    const tinygltf::Value& value = object.Get(key);
    if (!value.IsInt() && !required) return 0;
    if (!value.IsInt() || value.Get<int>() < 0)
        fail(where, "EXT_meshopt_compression has no valid '" + std::string(key) + "'");
    return size_t(value.Get<int>());
}

std::string textMember(const tinygltf::Value& object, const char* key) {
    const tinygltf::Value& value = object.Get(key);
    return value.IsString() ? value.Get<std::string>() : "";
}

}  // namespace

void GltfBuffers::spend(uint64_t bytes) {
    spentBytes_ += std::min(bytes, uint64_t(1) << 60);
    if (spentBytes_ > kFreeBytes + kMaxGrowth * sourceBytes_)
        throw Error(ErrorKind::resources,
                    name() + ": the file claims far more vertices, triangles or instances than its " +
                        std::to_string(sourceBytes_) + " bytes can hold");
}

void GltfBuffers::spendCompressed(uint64_t bytes) {
    decodedBytes_ += bytes;
    if (decodedBytes_ > kMaxDecodes * sourceBytes_)
        throw Error(ErrorKind::resources, name() + ": the file uses the same Draco data more than " +
                                              std::to_string(kMaxDecodes) + " times");
}

AlignedVector<std::byte> GltfBuffers::load(const GltfBufferSource& source, const std::string& where) const {
    const std::string& uri = *source.uri;
    if (tinygltf::IsDataURI(uri)) {
        std::vector<unsigned char> data;
        std::string mimeType;
        if (!tinygltf::DecodeDataURI(&data, mimeType, uri, 0, false)) fail(where, "its data URI is damaged");
        const auto* begin = reinterpret_cast<const std::byte*>(data.data());
        return {begin, begin + data.size()};
    }
    const std::filesystem::path path = percentDecoded(uri);
    const bool escapes = path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end();
    if (path.empty() || escapes || uri.find(':') != std::string::npos ||
        path.native().find('\0') != std::string::npos)
        fail(where, "its URI must name a file in the scene's folder or below");
    try {
        return readFile(directory_ / path);
    } catch (const Error& error) {
        throw Error(error.kind(), where + ": " + error.what());
    }
}

std::span<const std::byte> GltfBuffers::buffer(size_t number) {
    const std::string where = name() + ": buffer " + std::to_string(number);
    if (number >= buffers_.size()) fail(where, "the file has no such buffer");
    const GltfBufferSource& source = document_.buffers[number];
    std::span<const std::byte> bytes = document_.binaryChunk;
    if (source.uri) {
        if (buffers_[number].empty()) {
            buffers_[number] = load(source, where);
            sourceBytes_ += tinygltf::IsDataURI(*source.uri) ? 0 : buffers_[number].size();
        }
        bytes = buffers_[number];
    } else if (number != 0 || bytes.empty()) {
        fail(where, "it has no URI, and the file has no binary chunk for it");
    }
    if (source.byteLength > bytes.size())
        fail(where, "it has " + std::to_string(bytes.size()) + " of " + std::to_string(source.byteLength) +
                        " bytes");
    return bytes.first(source.byteLength);
}

std::span<const std::byte> GltfBuffers::range(size_t number, size_t offset, size_t length,
                                              const std::string& where) {
    const std::span<const std::byte> bytes = buffer(number);
    if (offset > bytes.size() || length > bytes.size() - offset)
        fail(where, "it reaches beyond buffer " + std::to_string(number));
    return bytes.subspan(offset, length);
}

AlignedVector<std::byte> GltfBuffers::decompress(const tinygltf::Value& extension, const std::string& where) {
    const auto source =
        range(sizeMember(extension, "buffer", where), sizeMember(extension, "byteOffset", where, false),
              sizeMember(extension, "byteLength", where), where);
    const size_t count = sizeMember(extension, "count", where),
                 stride = sizeMember(extension, "byteStride", where);
    const std::string mode = textMember(extension, "mode"), filter = textMember(extension, "filter");
    const bool vertices = mode == "ATTRIBUTES", triangles = mode == "TRIANGLES", indices = mode == "INDICES";
    const bool strideFits =
        vertices ? stride > 0 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4;
    if (!(vertices || triangles || indices) || !strideFits || (triangles && count % 3 != 0))
        fail(where, "EXT_meshopt_compression has a mode, stride or count that is not allowed");
    if (uint64_t(count) * stride > kMaxMeshoptGrowth * (source.size() + 256))
        fail(where, "EXT_meshopt_compression claims more elements than its data can hold");
    spend(uint64_t(count) * stride);

    AlignedVector<std::byte> result(count * stride);
    const auto* data = reinterpret_cast<const unsigned char*>(source.data());
    const int status =
        vertices    ? meshopt_decodeVertexBuffer(result.data(), count, stride, data, source.size())
        : triangles ? meshopt_decodeIndexBuffer(result.data(), count, stride, data, source.size())
                    : meshopt_decodeIndexSequence(result.data(), count, stride, data, source.size());
    if (status != 0) fail(where, "the EXT_meshopt_compression data is damaged");
    if (filter == "EXPONENTIAL" && vertices)
        meshopt_decodeFilterExp(result.data(), count, stride);
    else if (filter == "OCTAHEDRAL" && vertices && (stride == 4 || stride == 8))
        meshopt_decodeFilterOct(result.data(), count, stride);
    else if (filter == "QUATERNION" && vertices && stride == 8)
        meshopt_decodeFilterQuat(result.data(), count, stride);
    else if (!filter.empty() && filter != "NONE")
        fail(where, "EXT_meshopt_compression has a filter that is not allowed");
    return result;
}

std::span<const std::byte> GltfBuffers::view(int bufferView) {
    const std::string where = name() + ": buffer view " + std::to_string(bufferView);
    if (bufferView < 0 || size_t(bufferView) >= document_.model.bufferViews.size())
        fail(where, "the file has no such buffer view");
    const tinygltf::BufferView& view = document_.model.bufferViews[size_t(bufferView)];
    const auto extension = view.extensions.find("EXT_meshopt_compression");
    if (extension == view.extensions.end())
        return range(size_t(view.buffer), view.byteOffset, view.byteLength, where);
    const auto known = decompressed_.find(bufferView);
    if (known != decompressed_.end()) return known->second;
    return decompressed_[bufferView] = decompress(extension->second, where);
}

}  // namespace bvhio
