// SPDX-License-Identifier: MIT
// How far one engagement reaches: the longest row, and moves so short that several of them are one row.
#pragma once

#include "base/vec3.hpp"
#include "milling/cutter.hpp"
#include "motion/program.hpp"

namespace tribo::milling {

// Longest row, of the tip's path and half way up the cutter, mm: within what forces.csv promises, and a part
// of the cutter's diameter.
double longest_row_mm(const Cutter& cutter);

// The way of a move that counts against it, mm: of the tip or half way up the cutter, the longer one.
double row_way_mm(const motion::Move& move, const Cutter& cutter);

// Tells, move by move, what goes on the row of the move before. It hangs on the program alone, not on how
// much of it is milled at once. One thread.
class JoinedMoves {
  public:
    // True where the program's next move, which takes `duration_s`, shares a row with the one before it: the
    // same cutter, speed and feed, tip and shank going on as on the first move of that row, and all together
    // not longer than a row.
    bool add(const motion::Move& move, const Cutter& cutter, double spindle_rpm, double duration_s);

  private:
    // Half of a move.
    struct Way {
        Vec3 tip_mm, top_mm;  // of the tip, and of the upper end of the flutes
    };
    bool goes_on(const Way& way) const;

    bool open_ = false;  // the row may go on
    int count_ = 0;      // moves of the row
    double way_mm_ = 0, feed_mm_per_s_ = 0, spindle_rpm_ = 0;
    const Cutter* cutter_ = nullptr;
    Way first_;
    motion::ToolPose end_;
};

}  // namespace tribo::milling
