// SPDX-License-Identifier: MIT
// Settings of an APT program: units, feed, spindle, tool and cutter.
#pragma once

#include <optional>

#include "base/result.hpp"
#include "motion/path/program.hpp"
#include "readers/apt/lexer.hpp"
#include "readers/apt/report.hpp"

namespace tribo::readers::apt {

struct Feed {
    double value = 0;  // mm/min or mm per turn
    bool per_turn = false;
};

// Of MMPM, MMPR, IPM, IPR, FPM, FPR, PERMIN, PERREV. Null for another word.
struct FeedUnit {
    std::string_view word;
    double mm = 0;  // 0: the unit of the program
    bool per_turn = false;
};
const FeedUnit* feed_unit(std::string_view word);

// Refuses a feed out of its range. `at`: the number, for messages.
Result<Feed> feed_of(const Item& at, double value, bool per_turn, const Report& report);

struct Settings {
    double unit_mm = 1;
    bool unit_stated = false;
    std::optional<Feed> feed;
    double spindle_rpm = 0;        // 0: not stated
    bool spindle_stopped = false;  // by SPINDL/OFF
    bool spindle_stands = false;   // the last speed is 0
    int tool = 0;
    std::optional<motion::DeclaredTool> cutter;  // of the last CUTTER statement, without the tool number
    double diameter_mm = 0;                      // of the last CUTTER; 0: none so far
    bool is_nx = false;                          // a CLSF of NX: it has TLDATA
};

// UNITS/MM, UNITS/INCHES, UNITS/CM and other spellings.
Result<void> set_units(const Statement& statement, Settings& settings, Report& report);
// FEDRAT/ with a number and IPM, MMPM, FPM, IPR, MMPR, FPR, PERMIN or PERREV in any order. INVERS asks the
// postprocessor for inverse time and does not change the feed.
Result<void> set_feed(const Statement& statement, Settings& settings, Report& report);
// SPINDL/ with a speed, RPM, CLW, CCLW, ON or OFF in any order. SFM and SMM are surface speeds at the
// diameter of the cutter.
Result<void> set_spindle(const Statement& statement, Settings& settings, Report& report);
// LOADTL/n or LOAD/TOOL,n. The values after them set lengths, which do not move the tip.
Result<void> load_tool(const Statement& statement, Settings& settings, Report& report);
// TOOLNO/n,MILL or TURN. A turning tool is warned of.
void note_tool_kind(const Statement& statement, Report& report);
// CUTTER/d,r,e,f,a,b,h: diameter, corner radius, position of the corner centre (from the axis, above the
// tip), angles of bottom and flank, height.
Result<void> set_cutter(const Statement& statement, Settings& settings, Report& report);
// TLDATA/MILL,d,r,... of NX: diameter, corner radius, length, taper, tip. Other kinds give their diameter
// only.
Result<void> set_tool_data(const Statement& statement, Settings& settings, Report& report);

}  // namespace tribo::readers::apt
