// SPDX-License-Identifier: MIT
// How far one engagement reaches: the longest row, and which moves share rows.
#pragma once

#include "base/vec3.hpp"
#include "milling/tool/cutter.hpp"
#include "motion/path/program.hpp"

namespace tribo::milling {

// Longest row, of the tip's path and half way up the cutter, mm: within what forces.csv promises, and a part
// of the cutter's diameter.
double longest_row_mm(const Cutter& cutter);

// The way of a move that counts against it, mm: of the tip or half way up the cutter, the longer one.
double row_way_mm(const motion::Move& move, const Cutter& cutter);

// Rows that such a way takes.
double rows_of(double way_mm, const Cutter& cutter);

// Tells, move by move, what makes one pass with the move before. It hangs on the program alone, not on how
// much of it is milled at once. One thread.
class JoinedMoves {
  public:
    // True where the program's next move, which takes `duration_s`, joins the pass of the one before it: the
    // same cutter, speed and feed, tip and shank going on as on the first move of the pass, and fewer rows
    // together than apart.
    bool add(const motion::Move& move, const Cutter& cutter, double spindle_rpm, double duration_s);

  private:
    // Half of a move.
    struct Way {
        Vec3 tip_mm, top_mm;  // of the tip, and of the upper end of the flutes
    };
    bool goes_on(const Way& way) const;

    bool open_ = false;  // the pass may go on
    int count_ = 0;      // moves of the pass
    double way_mm_ = 0, feed_mm_per_s_ = 0, spindle_rpm_ = 0;
    const Cutter* cutter_ = nullptr;
    Way first_;
    motion::ToolPose end_;
};

}  // namespace tribo::milling
