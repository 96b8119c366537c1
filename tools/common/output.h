// Where a tool's output goes: standard output, or a file that appears whole or not at all.
#pragma once

#include <memory>
#include <ostream>
#include <string>

#include "file/safe_file.h"

namespace bvhio {

/// Removes the temporary files of every Output when SIGINT, SIGTERM or SIGHUP ends the process.
void removeTemporariesOnSignals();

enum class OutputKind { text, binary };

/// An output stream. A regular file is written beside its final place and renamed by commit(), so that a
/// failed or interrupted run leaves the old file whole and no part of the new one, and a tool may write the
/// file that it still has mapped. "-" is standard output; devices and pipes are written in place.
class Output {
  public:
    /// Opens the file, so that a wrong path is found out before the work. Throws Error: io; usage when binary
    /// data would go to a terminal, or where another output goes.
    Output(const std::string& path, OutputKind kind);
    /// Removes the temporary file unless commit() was called.
    ~Output();
    Output(const Output&) = delete;

    /// Errors of writing are thrown as Error{io} by the stream's own operations.
    std::ostream& stream();
    /// Flushes, closes and puts the file in place; throws Error{io} when any of that fails.
    void commit();

  private:
    class Slot;

    std::string name_;   // for messages
    std::string place_;  // taken by this output, so that no other goes there
    std::unique_ptr<Slot> slot_;
    std::unique_ptr<SafeFile> safe_;      // of a regular file
    std::unique_ptr<FileBuffer> buffer_;  // of what is written in place
    std::unique_ptr<std::ostream> stream_;
};

}  // namespace bvhio
