#include "file/safe_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/error.h"

namespace bvhio {
namespace {

[[noreturn]] void throwUnwritable(const std::string& name, int error) {
    throw Error(ErrorKind::io, name + ": cannot be written: " + std::strerror(error));
}

/// Waits until the names in the folder of `path` are on the disk. Some file systems cannot sync a folder: the
/// file itself is safe then, which is all that can be done.
void syncFolderOf(const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    const int file = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return;
    (void)!fsync(file);
    close(file);
}

}  // namespace

FileBuffer::FileBuffer(int file, std::string name)
    : file_(file), name_(std::move(name)), pending_(size_t(1) << 18) {
    resetPutArea();
}

FileBuffer::~FileBuffer() {
    if (file_ > STDERR_FILENO) close(file_);
}

void FileBuffer::waitForDisk() {
    sync();
    // EINVAL means that the descriptor does not support synchronization: a pipe, for instance.
    if (fsync(file_) != 0 && errno != EINVAL) throwUnwritable(name_, errno);
}

void FileBuffer::closeFile() {
    sync();
    const int file = std::exchange(file_, -1);
    if (close(file) != 0) throwUnwritable(name_, errno);
}

FileBuffer::int_type FileBuffer::overflow(int_type c) {
    sync();
    if (c != traits_type::eof()) sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
}

std::streamsize FileBuffer::xsputn(const char* data, std::streamsize size) {
    if (size > epptr() - pptr()) {
        sync();
        if (size > epptr() - pptr()) {
            writeAll(data, size_t(size));
            return size;
        }
    }
    std::memcpy(pptr(), data, size_t(size));
    pbump(int(size));
    return size;
}

int FileBuffer::sync() {
    const auto size = size_t(pptr() - pbase());
    resetPutArea();
    writeAll(pending_.data(), size);
    return 0;
}

void FileBuffer::writeAll(const char* data, size_t size) {
    while (size > 0) {
        const ssize_t written = write(file_, data, std::min(size, size_t(1) << 30));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0 && errno == EPIPE)
            throw Error(ErrorKind::io, name_ + ": cannot be written: the reader closed the pipe");
        if (written < 0) throwUnwritable(name_, errno);
        data += written;
        size -= size_t(written);
    }
}

std::string regularTarget(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::directory)
        throw Error(ErrorKind::io, path + ": is a directory: name a file");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return "";
    if (!std::filesystem::is_symlink(path, error)) return path;
    // Write to the link's target, so that the link stays.
    const auto target = std::filesystem::weakly_canonical(path, error);
    return error ? path : target.string();
}

SafeFile::SafeFile(const std::string& path, const std::string& name, TemporaryWatcher* watcher)
    : path_(path), name_(name), watcher_(watcher) {
    const int file = openTemporary();
    if (file < 0) throwUnwritable(name_, errno);
    buffer_ = std::make_unique<FileBuffer>(file, name_);
    stream_ = std::make_unique<std::ostream>(buffer_.get());
    stream_->exceptions(std::ios::badbit);  // so that what the buffer throws reaches the caller
}

int SafeFile::openTemporary() {
    for (int attempt = 0;; ++attempt) {
        temporary_ = path_ + ".tmp" + std::to_string(getpid()) + "-" + std::to_string(attempt);
        if (watcher_) watcher_->willExist(temporary_);
        const int file = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        const int error = errno;
        if (file >= 0) {
            exists_ = true;
            struct stat old {};
            if (stat(path_.c_str(), &old) == 0) (void)!fchmod(file, old.st_mode & 07777);
            return file;
        }
        if (watcher_) watcher_->isGone();
        errno = error;
        if (error != EEXIST) return file;
    }
}

SafeFile::~SafeFile() {
    if (!exists_) return;
    unlink(temporary_.c_str());
    if (watcher_) watcher_->isGone();
}

void SafeFile::commit(Durability durability) {
    if (durability == Durability::synced) buffer_->waitForDisk();
    buffer_->closeFile();
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) throwUnwritable(name_, errno);
    exists_ = false;
    if (watcher_) watcher_->isGone();
    if (durability == Durability::synced) syncFolderOf(path_);
}

}  // namespace bvhio
