// Where a tool's output goes: standard output, or a file that appears whole or not at all.
#pragma once

#include <memory>
#include <ostream>
#include <string>

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
    class Buffer;
    std::string name_;       // for messages
    std::string finalPath_;  // empty when written in place
    std::string temporary_;
    std::string place_;  // taken by this output, so that no other goes there
    std::unique_ptr<Buffer> buffer_;
    std::unique_ptr<std::ostream> stream_;
    int slot_ = -1;  // in the list of what signals remove
};

}  // namespace bvhio
