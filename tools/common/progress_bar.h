// The stages of a tool's work: they are timed, and shown on standard error while they last.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/progress.h"

namespace bvhio {

enum class ProgressMode { automatic, always, never };

/// How a stage is shown.
enum class StageKind {
    working,
    /// The stage waits for another process at the other end of a pipe. On a terminal it draws nothing: that
    /// process draws there.
    waiting,
};

/// Shows the stage that runs: on a terminal, once the tool has run for a second, as a line that is redrawn
/// with its time, and with a bar where the stage counts its progress; elsewhere as one line for each stage
/// that has run for a second.
class ProgressBar {
  public:
    ProgressBar(std::string tool, ProgressMode mode);
    ~ProgressBar();

    /// Ends the stage before, if any.
    void begin(const std::string& stage, StageKind kind = StageKind::working);
    void end();
    /// What the running stage counts.
    Progress& progress() { return progress_; }
    /// The finished stages in order, in seconds.
    const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }
    /// Seconds since the tool started.
    double elapsed() const;
    /// Seconds that the finished stage called `stage` took.
    double seconds(const std::string& stage) const;

  private:
    using Clock = std::chrono::steady_clock;
    void watch();
    void draw(double seconds);

    std::string tool_;
    bool shown_, redrawn_;
    Clock::time_point start_ = Clock::now(), stageStart_;
    std::vector<std::pair<std::string, double>> stages_;
    Progress progress_;

    std::mutex mutex_;  // guards what the watching thread reads: the members below, and the terminal's line
    std::string stage_;
    StageKind kind_ = StageKind::working;
    bool drawn_ = false, stopping_ = false;
    std::condition_variable wake_;
    std::thread watcher_;
};

}  // namespace bvhio
