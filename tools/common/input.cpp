#include "common/input.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace bvhio {

void refuseTerminalInput(const std::string& path) {
    if (path == "-" && isatty(STDIN_FILENO))
        throw Error(ErrorKind::usage, "no input: standard input is a terminal; name a file or use a pipe");
}

std::vector<std::byte> readStandardInput() {
    std::vector<std::byte> bytes;
    for (size_t size = 0;;) {
        if (bytes.size() - size < (1 << 16)) bytes.resize(bytes.size() * 2 + (1 << 16));
        const ssize_t got = read(STDIN_FILENO, bytes.data() + size, bytes.size() - size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0)
            throw Error(ErrorKind::io,
                        std::string("standard input: cannot be read: ") + std::strerror(errno));
        size += size_t(got);
        if (got == 0) {
            bytes.resize(size);
            return bytes;
        }
    }
}

}  // namespace bvhio
