#include "common/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>

#include "core/error.h"

namespace bvhio {
namespace {

// The files that a signal handler removes, in fixed memory because a handler may not allocate. A path is
// written before its flag is set.
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

/// The places of the process's outputs: final paths, and "-".
std::set<std::string>& placesTaken() {
    static std::set<std::string> places;
    return places;
}

/// The one spelling of a path that all paths to the same file share.
std::string placeOf(const std::string& finalPath) {
    std::error_code error;
    // Absolute first: the canonical form of a relative path to a file that does not exist stays relative.
    const auto place = std::filesystem::weakly_canonical(std::filesystem::absolute(finalPath, error), error);
    return error ? finalPath : place.string();
}

}  // namespace

void removeTemporariesOnSignals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        sigaction(signal, nullptr, &action);
        if (action.sa_handler == SIG_IGN) continue;  // nohup and background shells ask for that
        action.sa_handler = removeTemporariesAndDie;
        sigfillset(&action.sa_mask);
        action.sa_flags = 0;
        sigaction(signal, &action, nullptr);
    }
}

/// Registers an output's temporary file with the signal handler, as long as the file exists.
class Output::Slot : public TemporaryWatcher {
  public:
    ~Slot() override {
        temporary_.exists = false;
        temporary_.used = false;
    }
    void willExist(const std::string& path) override {
        std::snprintf(temporary_.path, sizeof temporary_.path, "%s", path.c_str());
        temporary_.exists = true;
    }
    void isGone() override { temporary_.exists = false; }

  private:
    Temporary& temporary_ = temporaries[reserveSlot()];
};

Output::Output(const std::string& path, OutputKind kind) : name_(path == "-" ? "standard output" : path) {
    const std::string finalPath = path == "-" ? "" : regularTarget(path);
    place_ = finalPath.empty() ? path : placeOf(finalPath);
    const bool isShared = path != "-" && finalPath.empty();  // devices take any number of outputs
    if (!isShared && !placesTaken().insert(place_).second)
        throw Error(ErrorKind::usage, name_ + ": is named for two outputs: name one file for each");
    if (!finalPath.empty()) {
        slot_ = std::make_unique<Slot>();
        safe_ = std::make_unique<SafeFile>(finalPath, name_, slot_.get());
        return;
    }
    const int file = path == "-" ? STDOUT_FILENO : open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) throw Error(ErrorKind::io, name_ + ": cannot be written: " + std::strerror(errno));
    isTerminal_ = isatty(file) == 1;
    struct stat status {};
    isPipe_ = fstat(file, &status) == 0 && (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode));
    if (kind == OutputKind::binary && isTerminal_) {
        if (file != STDOUT_FILENO) close(file);
        throw Error(ErrorKind::usage,
                    name_ + ": is a terminal, and the output is binary: use -o FILE or a pipe");
    }
    buffer_ = std::make_unique<FileBuffer>(file, name_);
    stream_ = std::make_unique<std::ostream>(buffer_.get());
    stream_->exceptions(std::ios::badbit);  // so that exceptions of the buffer reach the caller
}

Output::~Output() {
    safe_.reset();
    placesTaken().erase(place_);
}

std::ostream& Output::stream() {
    return safe_ ? safe_->stream() : *stream_;
}

void Output::commit() {
    if (safe_) return safe_->commit(Durability::none);
    buffer_->closeFile();
}

}  // namespace bvhio
