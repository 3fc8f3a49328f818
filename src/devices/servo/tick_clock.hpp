// SPDX-License-Identifier: MIT
// Clocks around one tick, with what reading them costs taken off.
#pragma once

#include <cstdint>

#include "devices/servo/duration_histogram.hpp"

namespace tribo::devices {

// Wall time (CLOCK_MONOTONIC) and processor time of the calling thread, ns. Real-time safe.
std::uint64_t wall_ns() noexcept;
std::uint64_t thread_cpu_ns() noexcept;

// Measures sections of one thread. Real-time safe but for the constructor, which measures empty sections for
// a few milliseconds.
class TickClock {
  public:
    TickClock();

    void begin() noexcept {
        cpu_start_ = thread_cpu_ns();
        wall_start_ = wall_ns();
    }
    // Records what has passed since begin(), less an empty section's median.
    void end() noexcept;

    const DurationHistogram& cpu() const { return cpu_; }
    const DurationHistogram& wall() const { return wall_; }
    // Empty sections, nothing taken off: what this machine does to a loop by itself.
    const DurationHistogram& empty_cpu() const { return empty_cpu_; }
    const DurationHistogram& empty_wall() const { return empty_wall_; }

  private:
    DurationHistogram cpu_, wall_, empty_cpu_, empty_wall_;
    std::uint64_t cpu_start_ = 0, wall_start_ = 0, cpu_cost_ = 0, wall_cost_ = 0;
};

}  // namespace tribo::devices
