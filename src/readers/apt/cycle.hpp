// SPDX-License-Identifier: MIT
// Canned cycles of APT: what is done at each GOTO until CYCLE/OFF.
#pragma once

#include <optional>

#include "readers/apt/path.hpp"

namespace tribo::readers::apt {

struct Cycle {
    enum class Way {
        through,  // down at feed, out at rapid
        peck,     // out of the hole after each peck
        chip,     // back a little after each peck
        bore,     // down and out at feed
    };
    Way way = Way::through;
    // Along the tool axis from the point of the GOTO, which lies where the hole begins, mm.
    double depth_mm = 0;      // FEDTO, DEPTH: below it
    double clearance_mm = 0;  // RAPTO, CLEAR: above it; the feed begins here
    double retract_mm =
        0;  // RTRCTO, RETURN: above it; where the tool ends; the clearance where none is given
    double first_peck_mm = 0, peck_mm = 0;  // 0: in one go
    double dwell_s = 0;                     // at the bottom
    std::optional<Feed> feed;               // else the one in force
    Item at;
};

// CYCLE/ with a kind and either words (FEDTO, DEPTH, RAPTO, CLEAR, RTRCTO, RETURN, STEP, 1STPECK, SUBPECK,
// DWELL, MMPM, ...) or, as CATIA and old processors write it, depth, feed and clearance in this order.
Result<Cycle> read_cycle(const Statement& statement, const Path& path, Report& report);

// The hole at `point`: rapid to the retract height over it, rapid to the clearance, down, out.
Result<void> drill(const Cycle& cycle, const motion::ToolPose& point, const Item& at, Path& path,
                   Report& report);

}  // namespace tribo::readers::apt
