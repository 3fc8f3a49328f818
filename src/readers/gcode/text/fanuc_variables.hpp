// SPDX-License-Identifier: MIT
// The system variables of a Fanuc control that this reader knows: modes of the program, positions, and the
// origins of work systems.
#pragma once

#include <optional>

#include "base/result.hpp"

namespace tribo::readers::gcode {

struct State;

// #100 to #199 and #500 to #999, and on Haas #10000 to #10999; between them the system variables.
constexpr bool is_common(int number) {
    return number <= 999 || (number >= 10'000 && number < 11'000);
}
// X, Y and Z where the last block ended (#5001), and where the tool is (#5041), in the coordinates of the
// program.
inline constexpr int kFirstBlockEnd = 5001, kFirstPlace = 5041;
// Direction of the last move at its end, X Y Z. No control has these: programs of others are written with
// them (control/fanuc_words.hpp).
inline constexpr int kFirstHeading = 99'901;
// The depth after which G73 and G83 clear the hole; 0: G83 after each peck, G73 never.
inline constexpr int kClearingDepth = 99'904;
inline constexpr int kAlarm = 3000, kStopWithMessage = 3006;

// Timers and clocks: #3001, #3002, date and time (#3011, #3012), and of Haas #3020 to #3025 (power on, cycle,
// feed, parts) and #5401 to #5600, how long a tool has cut and turned, but for the numbers in which a Fanuc
// control has the place of a skip.
constexpr bool is_timer(int number) {
    const bool is_skip = number > 5420 && number <= 5440;
    const bool is_of_tool = number > 5400 && number <= 5600 && !is_skip;
    const bool is_clock = number == 3001 || number == 3002 || number == 3011 || number == 3012;
    return is_of_tool || is_clock || (number >= 3020 && number <= 3025);
}

// Returns the value; none where only the control knows it. Lengths are in the unit in force.
std::optional<double> fanuc_system_variable(int number, const State& state);

// Sets the variable if it changes the state that moves depend on; false otherwise. Refuses values out of
// range, without a place.
Result<bool> set_fanuc_system_variable(int number, double value, State& state);

}  // namespace tribo::readers::gcode
