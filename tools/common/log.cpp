#include "common/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace bvhio {
namespace {

std::string oneLine(std::string_view text) {
    std::string line(text);
    for (char& c : line)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
    return line;
}

}  // namespace

void startLog(const std::string& tool) {
    auto logger = std::make_shared<spdlog::logger>(tool, std::make_shared<spdlog::sinks::stderr_sink_mt>());
    logger->set_pattern("%n: %v");
    spdlog::set_default_logger(std::move(logger));
    setLogLevel(LogLevel::normal);
}

void setLogLevel(LogLevel level) {
    spdlog::set_level(level == LogLevel::quiet    ? spdlog::level::err
                      : level == LogLevel::normal ? spdlog::level::warn
                                                  : spdlog::level::info);
}

bool isVerbose() {
    return spdlog::should_log(spdlog::level::info);
}

void logError(std::string_view message) {
    spdlog::error(oneLine(message));
}
void logNote(std::string_view message) {
    spdlog::warn("note: " + oneLine(message));
}
void logInfo(std::string_view message) {
    spdlog::info(oneLine(message));
}

}  // namespace bvhio
