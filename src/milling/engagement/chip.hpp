// SPDX-License-Identifier: MIT
// Checks whether the chips of a cut are within the limits of a cutter. A chip that is too thin is rubbed off;
// a chip that is too thick overloads the tooth. Both limits are rules of thumb (docs/force.md).
#pragma once

#include "milling/engagement/cut_row.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::milling {

// Below this thickness the edge rubs: about a third of the radius of a used carbide edge, mm.
inline constexpr double kRubbingChipMm = 0.01;
// Above this share of the cutter's diameter the chip overloads the tooth.
inline constexpr double kOverloadShare = 0.025;

// Live frames send its number.
enum class ChipVerdict { cuts, rubs, overloads };

// Returns the thickest chip that a tooth takes in one turn, mm: the largest travel of its edge along the
// normal of the envelope since the previous tooth. It is evaluated at the middle of each band. Run-out is
// left out.
double thickest_chip_mm(const Engagement& engagement, const ToolTravel& feed_per_tooth, const Cutter& cutter);

ChipVerdict chip_verdict(double thickest_mm, const Cutter& cutter);

// Findings of a whole program, collected row by row.
struct ChipFindings {
    double rubbing_s = 0;    // cutting time in which the teeth rub
    int rubbing_line = 0;    // the line with the longest rubbing without a break
    double overload = 0;     // thickest chip / limit of its cutter; > 1: overloaded
    double overload_mm = 0;  // that chip
    int overload_line = 0;
    std::size_t overloaded_lines = 0;

    // `thickest_mm` is the thickest chip of the row.
    void add(const CutRow& row, double thickest_mm, const Cutter& cutter);

  private:
    int open_line_ = 0, last_overloaded_ = 0;
    double open_s_ = 0, longest_s_ = 0;
};

}  // namespace tribo::milling
