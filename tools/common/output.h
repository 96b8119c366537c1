// A tool's output: standard output, or a file that appears complete or not at all.
#pragma once

#include <memory>
#include <ostream>
#include <string>

#include "file/safe_file.h"

namespace bvhio {

/// Removes the temporary files of every Output when SIGINT, SIGTERM or SIGHUP ends the process.
void removeTemporariesOnSignals();

enum class OutputKind { text, binary };

/// An output stream. A regular file is written beside its final place and renamed by commit(): a failed or
/// interrupted run leaves the old file as it was and no part of the new one, and a tool may write the file
/// that it still has mapped. "-" is standard output; devices and pipes are written in place.
class Output {
  public:
    /// Opens the file, so that a wrong path is reported before the work. Throws Error: io; usage when binary
    /// data would go to a terminal, or where another output goes.
    Output(const std::string& path, OutputKind kind);
    /// Removes the temporary file unless commit() was called.
    ~Output();
    Output(const Output&) = delete;

    /// Errors of writing are thrown as Error{io} by the stream's own operations.
    std::ostream& stream();
    /// Whether another process reads the output, so that writing may wait for it.
    bool isPipe() const { return isPipe_; }
    bool isTerminal() const { return isTerminal_; }
    /// Flushes, closes and renames the file; throws Error{io} when any of that fails.
    void commit();

  private:
    class Slot;

    std::string name_;   // for messages
    std::string place_;  // reserved for this output, so that no other goes there
    bool isPipe_ = false, isTerminal_ = false;
    std::unique_ptr<Slot> slot_;
    std::unique_ptr<SafeFile> safe_;      // of a regular file
    std::unique_ptr<FileBuffer> buffer_;  // of what is written in place
    std::unique_ptr<std::ostream> stream_;
};

}  // namespace bvhio
