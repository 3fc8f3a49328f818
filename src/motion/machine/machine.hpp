// SPDX-License-Identifier: MIT
// Description of a machine: a chain of axes from its frame to the part and one to the tool. Plain data; the
// mathematics is in kinematics.hpp. Any thread.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "base/vec3.hpp"

namespace tribo::motion {

// Values of the six axis words: X, Y, Z in mm, A, B, C in rad. A word that the machine lacks has no meaning.
struct Joints {
    Vec3 linear_mm;
    Vec3 rotary_rad;

    bool operator==(const Joints&) const = default;
};

// One axis. Its direction is physical: a growing word shifts the carried parts along it, or turns them
// right-handed about it. A table whose word X moves the tool towards +x of the part itself runs towards -x.
struct MachineAxis {
    char word = 'X';          // X Y Z A B C; the last three turn
    Vec3 direction{1, 0, 0};  // unit, machine frame with all axes at zero
    // Rotary axes: a point on the axis, mm, with all axes at zero. On the part's side it is in the machine
    // frame. On the tool's side it is relative to the spindle nose; the distance of the spindle nose from the
    // tip is the tool's length.
    Vec3 pivot_mm{};
    double zero = 0;  // value of the word in the position described here: mm or rad
    double min = -std::numeric_limits<double>::infinity();  // travel, in values of the word: mm or rad
    double max = std::numeric_limits<double>::infinity();
    double max_speed = std::numeric_limits<double>::infinity();  // of a rotary axis, rad/s

    bool turns() const { return word >= 'A' && word <= 'C'; }
};

// The origin of the machine frame is the position of the tool's tip at X0 Y0 Z0 with all rotary axes at zero,
// with the spindle pointing along +z.
struct Machine {
    std::string name;
    std::vector<MachineAxis> part_side;  // from the frame to the part
    std::vector<MachineAxis> tool_side;  // from the frame to the tool
    Vec3 stock_mm;                       // zero point of the stock, machine frame with all axes at zero
    // From the spindle nose to the tip. Only a machine that turns its head needs it, and only without tool
    // tip control or for its travel limits.
    std::optional<double> tool_length_mm;

    bool turns_head() const;
    // Returns the axis of a word, or null if the machine has none.
    const MachineAxis* axis(char word) const;
};

// Adds the missing ones of X, Y and Z to the machine: straight axes at the frame that move the tool.
void add_linear_axes(Machine& machine);

// Refuses an impossible chain: an axis twice, a direction without length, linear axes in one plane, more than
// two rotary axes, rotary axes that turn nothing, limits in the wrong order.
Result<void> check(const Machine& machine);

// Returns a machine known by name, with all axes through the machine's zero. The first six have unlimited
// travel and speed; the others have limits as machines of their kind have them, which differ from model to
// model:
//   xyzac-trt  A tilts the table about +x and carries C about +z: the table turns the way the words grow, as
//              LinuxCNC's kinematics of this name has it
//   xyzbc-trt  B about +y carries C about +z, likewise
//   xyzab-tdr  B about -y carries A about -x: the words name the tool's turn against the part (ISO 841)
//   head-head  C about +z carries B about +y, in the head (ISO 841)
//   head-table B about +y in the head, a table C about -z (ISO 841)
//   xyza       A about -x carries the part: a rotary indexer (ISO 841)
//   table-table       A about -x carries C about -z (ISO 841)
//   haas-umc          B about -y carries C about -z: a tilting table on a vertical mill
//   haas-tr           A about -x carries C about -z: a trunnion on a vertical mill
//   dmg-dmu           B about -y carries C about -z: a swivel rotary table
//   hermle-c          A about -x carries C about -z: a trunnion in a gantry
//   nutating-table    B about (0, -1, -1) carries C about -z: a table that swivels about an axis at 45
//   degrees nutating-head     C about -z in the table, B about (0, 1, 1) in the head nutating-head-head C
//   about +z carries B about (0, 1, 1), both in the head
Result<Machine> named_machine(std::string_view name);
// Returns their names, for messages: "xyzac-trt, xyzbc-trt, ...".
std::string machine_names();

}  // namespace tribo::motion
