// SPDX-License-Identifier: MIT
// How far a run is: a bar with the remaining time on a terminal, a plain line now and then elsewhere.
#pragma once

#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>

namespace tribo::app {

// The text of one state: `milling  [=====>    ]  52 %  0:12 left`, at most `columns` wide. remaining_s < 0:
// not known yet.
std::string progress_bar(const std::string& stage, double fraction, double remaining_s, int columns);
// `milling 52 %, 0:12 left`
std::string progress_line(const std::string& stage, double fraction, double remaining_s);

class Progress {
  public:
    // Writes to `out`; draws a bar where `out` is a terminal.
    explicit Progress(std::FILE* out = stderr);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();  // takes the bar away

    // The share of the whole run that is done, 0..1. May be called often and from any thread; most calls only
    // look at the clock.
    void update(const std::string& stage, double fraction);
    // Takes the bar away, so that something else can be printed.
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
