// SPDX-License-Identifier: MIT
// Summary of a program: lengths, extent, speeds and tools. It is computed move by move, so that the moves
// need not be stored. Any thread; allocates the tool list.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/path/program.hpp"

namespace tribo::motion {

// From the smallest to the largest value; both 0 if there is none.
struct Range {
    double least = 0, most = 0;
};

struct ProgramSummary {
    std::size_t moves = 0;  // feed moves and rapids
    std::size_t feed_moves = 0;
    double path_mm = 0;      // feed moves, true arc length
    double rapid_mm = 0;     // rapids whose start and end are known
    Box3 bounds_mm;          // of feed moves with their start points and true arcs; may be empty
    std::vector<int> tools;  // numbers of used tools, ascending, each once; without 0
    bool tilted = false;     // the tool axis leaves +z in a feed move
    double tilt_rad = 0;     // the largest tilt, at starts and ends of feed moves
    Range feed_mm_per_min;   // of feed moves
    Range spindle_rpm;       // of feed moves whose program gives it
    double feed_s = 0, rapid_s = 0, dwell_s = 0;  // at the programmed speeds, without acceleration
};

class ProgramMeter {
  public:
    void add(const Move& move);  // in the program's order
    // Summary of the moves so far; rapids run at `rapid_mm_per_min` > 0.
    ProgramSummary summary(double rapid_mm_per_min = 10'000) const;

  private:
    void add_feed(const Move& move);

    ProgramSummary so_far_;
    int last_tool_ = 0;
};

}  // namespace tribo::motion
