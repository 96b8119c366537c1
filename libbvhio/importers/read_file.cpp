#include "importers/read_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/error.h"

namespace bvhio {

AlignedVector<std::byte> readFile(const std::filesystem::path& path) {
    const auto fail = [&](int error) {
        throw Error(ErrorKind::io, path.string() + ": cannot be read: " + std::strerror(error));
    };
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) fail(errno);
    std::setvbuf(file.get(), nullptr, _IONBF, 0);
    std::error_code unknownSize;  // of a pipe, say
    const uintmax_t size = std::filesystem::file_size(path, unknownSize);
    // One byte more than the file has, so that one read finds its end.
    AlignedVector<std::byte> bytes(unknownSize ? size_t(1) << 16 : size_t(size) + 1);
    for (size_t got = 0;;) {
        const size_t part = std::fread(bytes.data() + got, 1, bytes.size() - got, file.get());
        got += part;
        if (got < bytes.size()) {
            if (std::ferror(file.get())) fail(errno);
            bytes.resize(got);
            return bytes;
        }
        bytes.resize(2 * bytes.size());
    }
}

}  // namespace bvhio
