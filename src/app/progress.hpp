// SPDX-License-Identifier: MIT
// Progress of a run: a bar with the remaining time on a terminal, plain lines from time to time elsewhere.
#pragma once

#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>

namespace tribo::app {

// The text of one state: `milling  [=====>    ]  52 %  0:12 left`, at most `columns` wide. remaining_s < 0:
// not known so far.
std::string progress_bar(const std::string& stage, double fraction, double remaining_s, int columns);
// `milling 52 %, 0:12 left`
std::string progress_line(const std::string& stage, double fraction, double remaining_s);

class Progress {
  public:
    // Writes to `out`; draws a bar if `out` is a terminal.
    explicit Progress(std::FILE* out = stderr);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();  // removes the bar

    // Sets the finished share of the whole run, 0..1. May be called often and from any thread; most calls
    // only read the clock.
    void update(const std::string& stage, double fraction);
    // Removes the bar, so that other text can be printed.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;

    std::FILE* out_;
    bool terminal_;
    bool drawn_ = false;
    std::mutex mutex_;
    Clock::time_point start_, last_;
    std::string last_stage_;
    double last_fraction_ = 0;
};

}  // namespace tribo::app
