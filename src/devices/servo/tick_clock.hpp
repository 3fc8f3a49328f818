// SPDX-License-Identifier: MIT
// Measures the duration of ticks, without the cost of reading the clocks.
#pragma once

#include <cstdint>

#include "devices/servo/duration_histogram.hpp"

namespace tribo::devices {

// Wall time (CLOCK_MONOTONIC) and processor time of the calling thread, ns. Real-time safe.
std::uint64_t wall_ns() noexcept;
std::uint64_t thread_cpu_ns() noexcept;

// Measures sections of one thread. Real-time safe, except for the constructor: it measures empty sections for
// a few milliseconds.
class TickClock {
  public:
    TickClock();

    void begin() noexcept {
        cpu_start_ = thread_cpu_ns();
        wall_start_ = wall_ns();
    }
    // Records the time since begin(), minus the median of an empty section.
    void end() noexcept;

    const DurationHistogram& cpu() const { return cpu_; }
    const DurationHistogram& wall() const { return wall_; }
    // Durations of empty sections, without correction: the jitter of this machine.
    const DurationHistogram& empty_cpu() const { return empty_cpu_; }
    const DurationHistogram& empty_wall() const { return empty_wall_; }

  private:
    DurationHistogram cpu_, wall_, empty_cpu_, empty_wall_;
    std::uint64_t cpu_start_ = 0, wall_start_ = 0, cpu_cost_ = 0, wall_cost_ = 0;
};

}  // namespace tribo::devices
