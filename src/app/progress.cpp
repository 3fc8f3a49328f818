// SPDX-License-Identifier: MIT
#include "app/progress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sys/ioctl.h>
#include <unistd.h>

namespace tribo::app {
namespace {

constexpr double kRedrawS = 0.1;         // of the bar
constexpr double kLineS = 5;             // between plain lines of one stage
constexpr double kFirstEstimateS = 0.5;  // an earlier estimate would be unstable
constexpr double kLeastShare = 0.01;     // the same
constexpr int kStageColumns = 10, kPlainColumns = 40;

std::string clock_text(double seconds) {
    const long s = std::lround(std::min(seconds, 359'999.0));
    std::array<char, 32> text = {};
    if (s >= 3600) {
        std::snprintf(text.data(), text.size(), "%ld:%02ld:%02ld left", s / 3600, s / 60 % 60, s % 60);
    } else {
        std::snprintf(text.data(), text.size(), "%ld:%02ld left", s / 60, s % 60);
    }
    return text.data();
}

int percent(double fraction) {
    return static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0));
}

int terminal_columns(int descriptor) {
    struct winsize size = {};
    return ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

double seconds(std::chrono::steady_clock::duration d) {
    return std::chrono::duration<double>(d).count();
}

}  // namespace

std::string progress_line(const std::string& stage, double fraction, double remaining_s) {
    std::string text = stage + " " + std::to_string(percent(fraction)) + " %";
    if (remaining_s >= 0) text += ", " + clock_text(remaining_s);
    return text;
}

std::string progress_bar(const std::string& stage, double fraction, double remaining_s, int columns) {
    std::array<char, 64> end = {};
    std::snprintf(end.data(), end.size(), "] %3d %%  %-13s", percent(fraction),
                  remaining_s >= 0 ? clock_text(remaining_s).c_str() : "");
    const std::string tail = end.data();
    std::string head = stage;
    head.resize(std::max<std::size_t>(head.size(), kStageColumns), ' ');
    head += " [";
    const int room = columns - 1 - static_cast<int>(head.size() + tail.size());
    if (columns < kPlainColumns || room < 4) {
        return progress_line(stage, fraction, remaining_s)
            .substr(0, static_cast<std::size_t>(std::max(columns - 1, 0)));
    }
    const int full = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * room);
    std::string bar(static_cast<std::size_t>(full), '=');
    if (full < room) bar += '>';
    bar.resize(static_cast<std::size_t>(room), ' ');
    return head + bar + tail;
}

Progress::Progress(std::FILE* out)
    : out_(out), terminal_(::isatty(::fileno(out)) == 1), start_(Clock::now()), last_(start_) {}

Progress::~Progress() {
    clear();
}

void Progress::clear() {
    const std::lock_guard lock(mutex_);
    if (!drawn_) return;
    std::fputs("\r\033[K", out_);
    std::fflush(out_);
    drawn_ = false;
}

void Progress::update(const std::string& stage, double fraction) {
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    const bool new_stage = stage != last_stage_;
    if (!new_stage && seconds(now - last_) < (terminal_ ? kRedrawS : kLineS)) return;
    last_ = now;
    last_stage_ = stage;
    last_fraction_ = std::max(last_fraction_, fraction);

    const double elapsed = seconds(now - start_);
    const bool known = elapsed > kFirstEstimateS && last_fraction_ > kLeastShare;
    const double remaining = known ? elapsed * (1 - last_fraction_) / last_fraction_ : -1;
    if (terminal_) {
        const std::string bar =
            progress_bar(stage, last_fraction_, remaining, terminal_columns(::fileno(out_)));
        std::fprintf(out_, "\r%s\033[K", bar.c_str());
        drawn_ = true;
    } else {
        std::fprintf(out_, "%s\n", progress_line(stage, last_fraction_, remaining).c_str());
    }
    std::fflush(out_);
}

}  // namespace tribo::app
