// SPDX-License-Identifier: MIT
// The G and M codes known to this reader, their modal groups, and messages for codes that it knows but does
// not read. The meaning is that of LinuxCNC where two controls differ.
#pragma once

#include <optional>
#include <string_view>

namespace tribo::readers::gcode {

// A block may have at most one code of a group.
enum class GGroup {
    non_modal,      // G4 G10 G28 G30 G52 G53 G92 G92.1 G92.2 G92.3
    macro_call,     // G65 G66; the other words of its block are arguments
    probing,        // G31 G38.2 to G38.5: nobody knows here where they stop
    motion,         // G0 G1 G2 G3 G5 to G5.3 G6.2 G73 G74 G76 G81 to G89
    cycle_end,      // G80; it may stand beside a motion
    plane,          // G17 G18 G19
    distance,       // G90 G91
    arc_distance,   // G90.1 G91.1
    feed_mode,      // G93 G94 G95
    units,          // G20 G21, G70 G71 without words of a cycle
    cutter_side,    // G40 G41 G41.1 G42 G42.1, in three dimensions G41.2 to G42.6
    tool_length,    // G43 G44 G49, and with tool tip control G43.4 G43.5 G168 G169 G234
    return_level,   // G98 G99
    work_offset,    // G54 to G59.3, G54.1 G154 G110 to G129
    path_control,   // G61 to G64
    spindle_mode,   // G97
    hole_pattern,   // G70 G71 G72 with words (Haas)
    polar,          // G15 G16
    scaling,        // G50 G51
    mirror,         // G50.1 G51.1
    rotation,       // G68 G69, and tilted planes G68.2 G68.3 G268 G269
    tool_to_plane,  // G53.1 G53.6 G253
    turning_zero,   // G254 G255 G54.2
    corner,         // G36 G39 with R (Fagor)
    cylinder,       // G7.1 G107
    round_pocket,   // G12 G13
    pocket,         // G150 with its words
    rigid_tap,      // G33.1
    idle,           // codes that move nothing; a block may have several
    count
};

enum class MGroup {
    stop,         // M0 M1 M2 M30 M60
    tool,         // M6
    spindle,      // M3 M4 M5, with coolant M13 M14
    coolant,      // M7 M8 M9
    overrides,    // M48 to M53
    orientation,  // M19
    saved_modes,  // M70 M71 M72
    outputs,      // M62 to M65, M67, M68
    subprogram,   // M97 M98 M99
    tool_tip,     // tool tip control: M128 M129, LinuxCNC's M428 M429 M430
    count
};

// Codes are counted in tenths: G90.1 is 901.
std::optional<GGroup> group_of_g(int tenths);
std::optional<MGroup> group_of_m(int tenths);

// Purpose of a code that is not read, and a remedy.
struct Unread {
    std::string_view what;
    std::string_view remedy;
};
// For a code without a group. `what` is empty for an unknown code.
Unread unread_g(int tenths);
// `what` is empty for a code that moves nothing on most machines: it is passed over with a warning.
Unread unread_m(int tenths);

}  // namespace tribo::readers::gcode
