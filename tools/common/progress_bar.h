// Stages of a tool's work: timed, and shown on standard error while they last.
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

/// Names the stage that runs. Work of over a second gets a line with its time, and a bar where the stage
/// counts its progress; on a terminal the line is redrawn, elsewhere each stage that takes long gets one.
class ProgressBar {
  public:
    ProgressBar(std::string tool, ProgressMode mode);
    ~ProgressBar();

    /// Ends the stage before, if any.
    void begin(const std::string& stage);
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

    std::mutex mutex_;  // guards what the watching thread reads: the two below and the line on the terminal
    std::string stage_;
    bool drawn_ = false, stopping_ = false;
    std::condition_variable wake_;
    std::thread watcher_;
};

}  // namespace bvhio
