// Files that appear whole or not at all.
#pragma once

#include <memory>
#include <ostream>
#include <streambuf>
#include <string>
#include <vector>

namespace bvhio {

/// Writes to a file descriptor, and throws Error{io}, with the system's reason, where it cannot. A stream
/// over it passes that on when its exceptions are set to badbit.
class FileBuffer : public std::streambuf {
  public:
    /// Takes over the descriptor; standard streams stay open. `name` is for messages.
    FileBuffer(int file, std::string name);
    ~FileBuffer() override;
    FileBuffer(const FileBuffer&) = delete;

    /// Writes what is pending and waits until the disk has all of it.
    void waitForDisk();
    /// Writes what is pending and closes the file.
    void closeFile();

  protected:
    int_type overflow(int_type c) override;
    std::streamsize xsputn(const char* data, std::streamsize size) override;
    int sync() override;

  private:
    void resetPutArea() { setp(pending_.data(), pending_.data() + pending_.size()); }
    void writeAll(const char* data, size_t size);

    int file_;
    std::string name_;
    std::vector<char> pending_;
};

/// Learns of a temporary file, so that a signal handler can remove it.
class TemporaryWatcher {
  public:
    virtual ~TemporaryWatcher() = default;
    virtual void willExist(const std::string& path) = 0;
    virtual void isGone() = 0;
};

/// What survives a power failure: none: no promise; synced: the whole file, once commit returns.
enum class Durability { none, synced };

/// Returns the regular file that `path` leads to, a symbolic link's target for instance, whether the file
/// exists or not. Returns "" for a device or a pipe. Throws Error{io} for a directory.
std::string regularTarget(const std::string& path);

/// A file that is written beside its final place and renamed by commit(). A failure leaves the old file whole
/// and no part of the new one. The old file may still be mapped meanwhile.
class SafeFile {
  public:
    /// Opens the temporary file, so that a wrong path is found before the work starts. The file gets the
    /// permissions of the file that it replaces. `path` must be a result of regularTarget, or a path that is
    /// known to be such. Throws Error{io}; `name` is for messages.
    SafeFile(const std::string& path, const std::string& name, TemporaryWatcher* watcher = nullptr);
    /// Removes the temporary file unless commit() was called.
    ~SafeFile();
    SafeFile(const SafeFile&) = delete;

    /// Errors of writing are thrown as Error{io} by the stream's own operations.
    std::ostream& stream() { return *stream_; }
    /// Flushes, closes and puts the file in place; throws Error{io} when any of that fails.
    void commit(Durability durability);

  private:
    int openTemporary();

    std::string path_, name_, temporary_;
    TemporaryWatcher* watcher_;
    std::unique_ptr<FileBuffer> buffer_;
    std::unique_ptr<std::ostream> stream_;
    bool exists_ = false;  // whether the temporary file exists
};

}  // namespace bvhio
