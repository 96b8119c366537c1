// Fuzzes the reader of containers. Any bytes are either rejected with an Error, or a valid file: then writing
// its content and reading it again gives the same content.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "container/container.h"
#include "container/digest.h"
#include "core/hash.h"
#include "file/bvhx_file.h"
#include "file/check.h"

namespace {

using namespace bvhio;

void require(bool condition) {
    if (!condition) std::abort();
}

std::string written(const BvhxFile& file, const WriteOptions& options) {
    std::ostringstream out;
    writeBvhx(out, file, options);
    return out.str();
}

std::span<const std::byte> asBytes(const std::string& text) {
    return std::as_bytes(std::span(text));
}

/// Corrects the checksums and totals in a file's bytes, as far as its sizes make sense. Otherwise nearly
/// every mutation would end at the first checksum, and nothing after it would be tested.
std::string repaired(std::span<const std::byte> bytes) {
    std::string file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto put = [&](size_t at, uint64_t value) { std::memcpy(file.data() + at, &value, 8); };
    const auto get = [&](size_t at) {
        uint64_t value = 0;
        std::memcpy(&value, file.data() + at, 8);
        return value;
    };
    const auto part = [&](size_t at, size_t count) { return asBytes(file).subspan(at, count); };
    if (file.size() < 64) return file;
    put(56, hash64(part(0, 56)));
    ContentHash content;
    uint64_t chunks = 0;
    for (size_t at = 64; at + 64 <= file.size();) {
        ChunkHeader header;
        std::memcpy(&header.type, file.data() + at, 4);
        std::memcpy(&header.flags, file.data() + at + 4, 4);
        std::memcpy(&header.codec, file.data() + at + 8, 4);
        header.rawSize = get(at + 16);
        const uint64_t size = get(at + 24), room = file.size() - at - 64;
        if (size > room || header.rawSize > (size_t(1) << 26)) break;
        const size_t next = std::min<size_t>(file.size(), at + 64 + (size + 63) / 64 * 64);
        if (header.type == kEndType && size == 32) {
            put(at + 64, content.value());
            put(at + 72, chunks);
            put(at + 80, next);
        }
        const auto stored = part(at + 64, size);
        put(at + 32, digest(stored));
        put(at + 56, hash64(part(at, 56)));
        AlignedVector<std::byte> raw(header.rawSize);
        const Codec* codec = findCodec(header.codec);
        if (codec && codec->function.decode(stored, raw)) content.add(header, digest(raw));
        ++chunks;
        at = next;
    }
    return file;
}

void tryBytes(std::span<const std::byte> bytes) {
    const auto findings = checkBytes(bytes, "fuzz");
    bool sound = true;
    for (const Finding& finding : findings) sound &= finding.severity == Finding::Severity::warning;
    try {
        const BvhxFile file = readBvhx(bytes, "fuzz");
        require(sound);
        const std::string plain = written(file, {}),
                          packed = written(file, {.codec = "zstd", .codecLevel = 1});
        require(written(readBvhx(asBytes(plain), "plain"), {}) == plain);
        require(written(readBvhx(asBytes(packed), "packed"), {}) == plain);
        if (traitsOf(file.bvh).isExact) {
            const std::string topology = written(file, {.nodes = NodeEncoding::topology});
            require(written(readBvhx(asBytes(topology), "topology"), {}) == plain);
        }
    } catch (const Error& error) {
        require(!sound);
        require(error.kind() == ErrorKind::invalid || error.kind() == ErrorKind::unsupported);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::span<const std::byte> bytes{reinterpret_cast<const std::byte*>(data), size};
    tryBytes(bytes);
    tryBytes(asBytes(repaired(bytes)));
    return 0;
}
