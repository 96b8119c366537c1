#include "common/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace bvhio {
namespace {

constexpr double kPatience = 1.0;  // seconds before anything is shown
constexpr auto kRedraw = std::chrono::milliseconds(200);
constexpr int kBarWidth = 30;
constexpr const char* kClearLine = "\r\033[K";

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

ProgressBar::ProgressBar(std::string tool, ProgressMode mode) : tool_(std::move(tool)) {
    redrawn_ = isatty(STDERR_FILENO);
    shown_ = mode == ProgressMode::always || (mode == ProgressMode::automatic && redrawn_);
    if (shown_) watcher_ = std::thread([this] { watch(); });
}

ProgressBar::~ProgressBar() {
    if (!shown_) return;
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        if (drawn_ && redrawn_) std::fputs(kClearLine, stderr);
    }
    wake_.notify_one();
    watcher_.join();
}

void ProgressBar::begin(const std::string& stage, StageKind kind) {
    end();
    const std::lock_guard lock(mutex_);
    progress_.start(0);
    stage_ = stage;
    kind_ = kind;
    stageStart_ = Clock::now();
    drawn_ = false;
}

void ProgressBar::end() {
    const std::lock_guard lock(mutex_);
    if (stage_.empty()) return;
    stages_.emplace_back(stage_, secondsSince(stageStart_));
    stage_.clear();
    if (drawn_ && redrawn_) std::fputs(kClearLine, stderr);
    drawn_ = false;
}

double ProgressBar::elapsed() const {
    return secondsSince(start_);
}

double ProgressBar::seconds(const std::string& stage) const {
    double sum = 0;
    for (const auto& [name, seconds] : stages_) sum += name == stage ? seconds : 0;
    return sum;
}

void ProgressBar::watch() {
    std::unique_lock lock(mutex_);
    while (!stopping_) {
        wake_.wait_for(lock, kRedraw, [this] { return stopping_; });
        if (stopping_ || stage_.empty()) continue;
        const double seconds = secondsSince(stageStart_);
        const bool isShown = redrawn_ ? kind_ == StageKind::working && elapsed() >= kPatience
                                      : !drawn_ && seconds >= kPatience;
        if (isShown) draw(seconds);
    }
}

void ProgressBar::draw(double seconds) {
    const uint64_t total = progress_.total, done = std::min<uint64_t>(progress_.done, total);
    std::string line = tool_ + ": " + stage_;
    if (total > 0) {
        const auto filled = size_t(double(done) / double(total) * kBarWidth);
        line += " [" + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + "]";
    }
    if (redrawn_)
        std::fprintf(stderr, "%s%s %.1f s", kClearLine, line.c_str(), seconds);
    else
        std::fprintf(stderr, "%s\n", line.c_str());
    drawn_ = true;
}

}  // namespace bvhio
