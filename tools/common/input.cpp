#include "common/input.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "core/error.h"

namespace bvhio {

void refuseTerminalInput(const std::string& path) {
    if (path == "-" && isatty(STDIN_FILENO))
        throw Error(ErrorKind::usage, "no input: standard input is a terminal; name a file or use a pipe");
}

std::vector<std::byte> readWholeFile(const std::string& path) {
    const std::string name = path == "-" ? "standard input" : path;
    const auto fail = [&]() {
        throw Error(ErrorKind::io, name + ": cannot be read: " + std::strerror(errno));
    };
    const int file = path == "-" ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) fail();
    const std::unique_ptr<const int, void (*)(const int*)> closing(&file, [](const int* f) {
        if (*f != STDIN_FILENO) close(*f);
    });
    std::vector<std::byte> bytes;
    for (size_t size = 0;;) {
        if (bytes.size() - size < (1 << 16)) bytes.resize(bytes.size() * 2 + (1 << 16));
        const ssize_t got = read(file, bytes.data() + size, bytes.size() - size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail();
        size += size_t(got);
        if (got == 0) {
            bytes.resize(size);
            return bytes;
        }
    }
}

}  // namespace bvhio
