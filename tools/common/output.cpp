#include "common/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "core/error.h"

namespace bvhio {
namespace {

// What a signal handler removes: fixed memory, since a handler may not allocate. A path is written before its
// flag is set.
struct Temporary {
    std::atomic<bool> used{false}, exists{false};
    char path[PATH_MAX];
};
Temporary temporaries[8];

extern "C" void removeTemporariesAndDie(int signal) {
    for (const Temporary& temporary : temporaries)
        if (temporary.exists) unlink(temporary.path);
    std::signal(signal, SIG_DFL);
    raise(signal);
}

int reserveSlot() {
    for (int i = 0; i < int(std::size(temporaries)); ++i)
        if (!temporaries[i].used.exchange(true)) return i;
    throw Error(ErrorKind::resources, "too many output files at once");
}

[[noreturn]] void throwIo(const std::string& name, const char* what, int error) {
    throw Error(ErrorKind::io, name + ": " + what + ": " + std::strerror(error));
}

/// The file that `path` names in the end, or "" when it exists and is no regular file.
std::string regularTarget(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::directory)
        throw Error(ErrorKind::io, path + ": is a directory: name a file");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return "";
    if (!std::filesystem::is_symlink(path, error)) return path;
    const auto target =
        std::filesystem::weakly_canonical(path, error);  // writing through a link keeps the link
    return error ? path : target.string();
}

/// Where the process's outputs go: final paths, and "-".
std::set<std::string>& placesTaken() {
    static std::set<std::string> places;
    return places;
}

/// One spelling for each file.
std::string placeOf(const std::string& finalPath) {
    std::error_code error;
    // Absolute first: of a relative path to no file yet, the canonical form would stay relative.
    const auto place = std::filesystem::weakly_canonical(std::filesystem::absolute(finalPath, error), error);
    return error ? finalPath : place.string();
}

}  // namespace

void removeTemporariesOnSignals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        sigaction(signal, nullptr, &action);
        if (action.sa_handler == SIG_IGN) continue;  // as nohup and background shells want it
        action.sa_handler = removeTemporariesAndDie;
        sigfillset(&action.sa_mask);
        action.sa_flags = 0;
        sigaction(signal, &action, nullptr);
    }
}

/// Writes to a file descriptor and throws Error{io}, with the system's reason, where it cannot.
class Output::Buffer : public std::streambuf {
  public:
    Buffer(int file, const std::string& name) : file_(file), name_(name), pending_(1 << 18) {
        resetPutArea();
    }
    ~Buffer() override {
        if (file_ > STDERR_FILENO) close(file_);
    }
    void closeFile() {
        sync();
        const int file = std::exchange(file_, -1);
        if (close(file) != 0) throwIo(name_, "cannot be written", errno);
    }

  protected:
    int_type overflow(int_type c) override {
        sync();
        if (c != traits_type::eof()) sputc(traits_type::to_char_type(c));
        return traits_type::not_eof(c);
    }
    std::streamsize xsputn(const char* data, std::streamsize size) override {
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
    int sync() override {
        const auto size = size_t(pptr() - pbase());
        resetPutArea();
        writeAll(pending_.data(), size);
        return 0;
    }

  private:
    void resetPutArea() { setp(pending_.data(), pending_.data() + pending_.size()); }
    void writeAll(const char* data, size_t size) {
        while (size > 0) {
            const ssize_t written = write(file_, data, std::min(size, size_t(1) << 30));
            if (written < 0 && errno == EINTR) continue;
            if (written < 0 && errno == EPIPE)
                throw Error(ErrorKind::io, name_ + ": cannot be written: the reader closed the pipe");
            if (written < 0) throwIo(name_, "cannot be written", errno);
            data += written;
            size -= size_t(written);
        }
    }

    int file_;
    std::string name_;
    std::vector<char> pending_;
};

Output::Output(const std::string& path, OutputKind kind) : name_(path == "-" ? "standard output" : path) {
    int file = STDOUT_FILENO;
    if (path != "-") finalPath_ = regularTarget(path);
    place_ = path == "-" || finalPath_.empty() ? path : placeOf(finalPath_);
    const bool isShared = path != "-" && finalPath_.empty();  // devices take any number of outputs
    if (!isShared && !placesTaken().insert(place_).second)
        throw Error(ErrorKind::usage, name_ + ": two outputs go there: name a file for each");
    if (path != "-") {
        if (finalPath_.empty()) {
            file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
        } else {
            slot_ = reserveSlot();
            Temporary& temporary = temporaries[slot_];
            for (int attempt = 0;; ++attempt) {
                temporary_ = finalPath_ + ".tmp" + std::to_string(getpid()) + "-" + std::to_string(attempt);
                std::snprintf(temporary.path, sizeof temporary.path, "%s", temporary_.c_str());
                temporary.exists = true;
                file = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
                if (file >= 0) break;
                temporary.exists = false;
                if (errno != EEXIST) break;
            }
            struct stat old {};
            if (file >= 0 && stat(finalPath_.c_str(), &old) == 0) (void)!fchmod(file, old.st_mode & 07777);
        }
        if (file < 0) {
            const int error = errno;
            if (slot_ >= 0) temporaries[slot_].used = false;
            throwIo(name_, "cannot be written", error);
        }
    }
    if (kind == OutputKind::binary && isatty(file)) {
        if (file != STDOUT_FILENO) close(file);
        throw Error(ErrorKind::usage,
                    name_ + ": is a terminal, and the output is binary: use -o FILE or a pipe");
    }
    buffer_ = std::make_unique<Buffer>(file, name_);
    stream_ = std::make_unique<std::ostream>(buffer_.get());
    stream_->exceptions(std::ios::badbit);  // so that what the buffer throws reaches the caller
}

Output::~Output() {
    placesTaken().erase(place_);
    if (slot_ < 0) return;
    if (temporaries[slot_].exists) unlink(temporary_.c_str());
    temporaries[slot_].exists = false;
    temporaries[slot_].used = false;
}

std::ostream& Output::stream() {
    return *stream_;
}

void Output::commit() {
    buffer_->closeFile();
    if (finalPath_.empty()) return;
    if (std::rename(temporary_.c_str(), finalPath_.c_str()) != 0) throwIo(name_, "cannot be written", errno);
    temporaries[slot_].exists = false;
}

}  // namespace bvhio
