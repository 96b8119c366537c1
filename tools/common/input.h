// The input of a tool: scenes, rays and containers, from files or from standard input.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/progress_bar.h"
#include "file/bvhx_file.h"

namespace bvhio {

/// Throws Error{usage} when `path` is "-" and standard input is a terminal: nobody types a binary file.
void refuseTerminalInput(const std::string& path);

/// "standard input" for "-", else the path: for messages.
std::string inputName(const std::string& path);

/// How a stage that reads `path` is shown: a pipe is waited for.
StageKind readingKind(const std::string& path);

/// All bytes of a file; "-" is standard input. Throws Error{io}.
std::vector<std::byte> readWholeFile(const std::string& path);

/// Reads a container; "-" is standard input. Throws as readBvhx does; the message for a scene file says that
/// bvh-build reads it.
BvhxFile readContainer(const std::string& path);
/// The same from memory; `name` is for messages.
BvhxFile readContainer(std::span<const std::byte> bytes, const std::string& name);

}  // namespace bvhio
