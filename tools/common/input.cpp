#include "common/input.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include "container/byte_source.h"
#include "core/findings.h"
#include "importers/import.h"

namespace bvhio {
namespace {

/// Throws Error{invalid} when `bytes` are those of a scene file.
void refuseScene(std::span<const std::byte> bytes, const std::string& name) {
    const std::string kind(sceneKind(bytes, name));
    if (kind.empty()) return;
    const char* article = kind == "OBJ" || kind == "STL" ? "an " : "a ";
    throw Error(ErrorKind::invalid,
                name + ": is " + article + kind + " file, not a .bvhx: run bvh-build on it first");
}

/// Copies the first bytes of standard input, which stay there; none where the system cannot.
std::vector<std::byte> peekStandardInput() {
    std::vector<std::byte> bytes(1 << 12);
    ssize_t got = pread(STDIN_FILENO, bytes.data(), bytes.size(), lseek(STDIN_FILENO, 0, SEEK_CUR));
    int copy[2];
    if (got < 0 && pipe2(copy, O_CLOEXEC) == 0) {
        got = tee(STDIN_FILENO, copy[1], bytes.size(), 0);
        if (got > 0) got = read(copy[0], bytes.data(), size_t(got));
        close(copy[0]);
        close(copy[1]);
    }
    bytes.resize(size_t(std::max<ssize_t>(got, 0)));
    return bytes;
}

}  // namespace

void refuseTerminalInput(const std::string& path) {
    if (path == "-" && isatty(STDIN_FILENO))
        throw Error(ErrorKind::usage, "no input: standard input is a terminal; name a file or use a pipe");
}

std::string inputName(const std::string& path) {
    return path == "-" ? "standard input" : path;
}

StageKind readingKind(const std::string& path) {
    struct stat status {};
    const int failed = path == "-" ? fstat(STDIN_FILENO, &status) : stat(path.c_str(), &status);
    return failed == 0 && S_ISFIFO(status.st_mode) ? StageKind::waiting : StageKind::working;
}

std::vector<std::byte> readWholeFile(const std::string& path) {
    const std::string name = inputName(path);
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

BvhxFile readContainer(const std::string& path) {
    if (path == "-") refuseScene(peekStandardInput(), inputName(path));
    try {
        return readBvhx(path);
    } catch (const FindingError& error) {
        std::error_code unknown;
        if (error.finding().id == FindingId::signature && std::filesystem::is_regular_file(path, unknown))
            refuseScene(openSource(path)->take(std::filesystem::file_size(path)), path);  // maps the file
        throw;
    }
}

BvhxFile readContainer(std::span<const std::byte> bytes, const std::string& name) {
    try {
        return readBvhx(bytes, name);
    } catch (const FindingError& error) {
        if (error.finding().id == FindingId::signature) refuseScene(bytes, name);
        throw;
    }
}

}  // namespace bvhio
