// SPDX-License-Identifier: MIT
// Whether the chips of a cut are within what a cutter bears: too thin a chip is rubbed off, too thick a one
// overloads the tooth. Both limits are rules of thumb (docs/force.md).
#pragma once

#include "milling/engagement/cut_row.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::milling {

// Below this the edge rubs: about a third of the radius of a used carbide edge, mm.
inline constexpr double kRubbingChipMm = 0.01;
// Above this share of the cutter's diameter a tooth is overloaded.
inline constexpr double kOverloadShare = 0.025;

// Live frames tell it by its number.
enum class ChipVerdict { cuts, rubs, overloads };

// The thickest chip that a tooth takes in one turn, mm: the largest travel of its edge along the envelope's
// normal since the tooth before, over the middles of all bands. Run-out is left out.
double thickest_chip_mm(const Engagement& engagement, const ToolTravel& feed_per_tooth, const Cutter& cutter);

ChipVerdict chip_verdict(double thickest_mm, const Cutter& cutter);

// What the rows of a whole program say, gathered row by row.
struct ChipFindings {
    double rubbing_s = 0;    // cutting time in which the teeth rub
    int rubbing_line = 0;    // with the most of that time without a break
    double overload = 0;     // the thickest chip over the limit of its cutter; > 1: overloaded
    double overload_mm = 0;  // that chip
    int overload_line = 0;
    std::size_t overloaded_lines = 0;

    // `thickest_mm`: the row's chip.
    void add(const CutRow& row, double thickest_mm, const Cutter& cutter);

  private:
    int open_line_ = 0, last_overloaded_ = 0;
    double open_s_ = 0, longest_s_ = 0;
};

}  // namespace tribo::milling
