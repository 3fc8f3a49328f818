// SPDX-License-Identifier: MIT
// The longest row of one engagement, and the moves that share rows.
#pragma once

#include "base/vec3.hpp"
#include "milling/tool/cutter.hpp"
#include "motion/path/program.hpp"

namespace tribo::milling {

// Returns the longest row, mm, along the path of the tip and half way up the cutter: within the limit that
// forces.csv promises, and at most a share of the cutter's diameter.
double longest_row_mm(const Cutter& cutter);

// Returns the length of a move that counts against this limit, mm: the longer one of the paths of the tip and
// of the point half way up the cutter.
double row_way_mm(const motion::Move& move, const Cutter& cutter);

// Returns the number of rows of this length.
double rows_of(double way_mm, const Cutter& cutter);

// Returns true for a short move: if it joins a pass, its sweep and that of the move before it are one shape.
bool shares_sweep(const motion::Move& move, const Cutter& cutter);

// Decides, move by move, if a move forms one pass with the move before it. The result depends on the program
// alone, not on the number of moves that are milled at once. One thread.
class JoinedMoves {
  public:
    // Returns true if the next move of the program, which takes `duration_s`, joins the pass of the move
    // before it. Conditions: the same cutter, speed and feed; tip and shank continue as on the first move of
    // the pass; together the moves need fewer rows than alone.
    bool add(const motion::Move& move, const Cutter& cutter, double spindle_rpm, double duration_s);

  private:
    // Half of a move.
    struct Way {
        Vec3 tip_mm, top_mm;  // of the tip, and of the upper end of the flutes
    };
    bool goes_on(const Way& way) const;

    bool open_ = false;  // another move may join the pass
    int count_ = 0;      // number of moves in the pass
    double way_mm_ = 0, feed_mm_per_s_ = 0, spindle_rpm_ = 0;
    const Cutter* cutter_ = nullptr;
    Way first_;
    motion::ToolPose end_;
};

}  // namespace tribo::milling
