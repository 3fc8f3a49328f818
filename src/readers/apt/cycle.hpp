// SPDX-License-Identifier: MIT
// Canned cycles of APT: the moves at each GOTO until CYCLE/OFF.
#pragma once

#include <optional>

#include "readers/apt/path.hpp"

namespace tribo::readers::apt {

struct Cycle {
    enum class Way {
        through,  // down at feed, out at rapid
        peck,     // out of the hole after each peck
        chip,     // back by a short distance after each peck
        bore,     // down and out at feed
    };
    Way way = Way::through;
    // Lengths along the tool axis from the point of the GOTO (the top of the hole), mm.
    double depth_mm = 0;      // FEDTO, DEPTH: below it
    double clearance_mm = 0;  // CLEAR, RAPTO, or CLEAR less RAPTO: above it; the feed begins here
    double retract_mm = 0;    // RTRCTO, RETURN: above it; the tool ends here; default: the clearance
    double first_peck_mm = 0, peck_mm = 0;  // 0: no pecks
    double chip_mm = 0;                     // BACK: way back that breaks a chip; 0: not stated
    double dwell_s = 0;                     // at the bottom
    std::optional<Feed> feed;               // absent: the feed in force
    Item at;
};

// Reads CYCLE/ with a kind and its values. The values are words (FEDTO, DEPTH, RAPTO, CLEAR, RTRCTO, RETURN,
// STEP, 1STPECK, SUBPECK, DWELL, MMPM, ...) or, in CATIA, Creo and old processors, depth, feed and clearance
// in this order.
Result<Cycle> read_cycle(const Statement& statement, const Path& path, Report& report);

// CYCLE/ON with words changes the cycle that was described before it (NX): adds them to `changes`, which
// stand behind its own words, in place of those of the same name.
void change_words(const Statement& on, std::vector<Item>& changes);

// Makes the moves of the hole at `point`: rapid to the retract height above it, rapid to the clearance, down,
// out.
Result<void> drill(const Cycle& cycle, const motion::ToolPose& point, const Item& at, Path& path,
                   Report& report);

}  // namespace tribo::readers::apt
