// SPDX-License-Identifier: MIT
// A program at a glance: how far, where, how fast and with which tools. Move by move, so that nobody has to
// hold them all. Any thread; allocates the tool list.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/path/program.hpp"

namespace tribo::motion {

// From the smallest to the largest; both 0 where there is none.
struct Range {
    double least = 0, most = 0;
};

struct ProgramSummary {
    std::size_t moves = 0;  // feed moves and rapids
    std::size_t feed_moves = 0;
    double path_mm = 0;      // feed moves, true arc length
    double rapid_mm = 0;     // rapids whose start and end are known
    Box3 bounds_mm;          // of feed moves with their start points, arcs to their true extent; may be empty
    std::vector<int> tools;  // numbers that moves use, ascending, each once; without 0
    bool rotary = false;     // axis words A B C, which need a machine
    bool tilted = false;     // the tool axis leaves +z in a feed move
    double tilt_rad = 0;     // the most that it does, at starts and ends of feed moves
    Range feed_mm_per_min;   // of feed moves
    Range spindle_rpm;       // of feed moves whose program states it
    double feed_s = 0, rapid_s = 0, dwell_s = 0;  // at the programmed speeds, without acceleration
};

class ProgramMeter {
  public:
    void add(const Move& move);  // in the program's order
    // Of the moves so far; rapids run at `rapid_mm_per_min` > 0. `rotary` is the program's to say.
    ProgramSummary summary(double rapid_mm_per_min = 10'000) const;

  private:
    void add_feed(const Move& move);

    ProgramSummary so_far_;
    int last_tool_ = 0;
};

// The same of a program's moves.
ProgramSummary describe(const Program& program, double rapid_mm_per_min = 10'000);

}  // namespace tribo::motion
