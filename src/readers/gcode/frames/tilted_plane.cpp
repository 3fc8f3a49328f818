// SPDX-License-Identifier: MIT
#include "readers/gcode/frames/tilted_plane.hpp"

#include <array>
#include <cmath>
#include <string>

#include "base/math.hpp"
#include "readers/control/path.hpp"
#include "readers/gcode/motion/moves.hpp"
#include "readers/gcode/motion/rotary.hpp"

namespace tribo::readers::gcode {
namespace {

// A plane tilted by less leaves the tool where it is.
constexpr double kSameDirection = 1e-12;

// The axes of the work system, in the stock.
motion::WorkFrame work_frame(const State& state) {
    const double turn_deg = state.active().turn_deg;
    motion::WorkFrame frame;
    frame.x = turned(frame.x, turn_deg);
    frame.y = turned(frame.y, turn_deg);
    frame.origin_mm = turned(state.origin_mm(), turn_deg);
    return frame;
}

// The tip in the stock; absent where it is not known.
std::optional<Vec3> tip_in_stock(const State& state, const Output& output) {
    if (!state.knows_tip()) return std::nullopt;
    if (state.tilt) return state.tilt->frame.in_stock(state.tip_mm);
    const Vec3 place = turned(state.tip_mm, state.active().turn_deg);
    if (!output.machine || state.rotary.tip_control) return place;
    if (output.machine->needs_tool_length(state.rotary.now_rad)) return std::nullopt;
    const motion::Kinematics& kinematics = output.machine->kinematics();
    return kinematics.pose({place + kinematics.stock_mm(), state.rotary.now_rad}).tip_mm;
}

void lose_tip(State& state, int line) {
    for (Known& known : state.known) {
        if (known == Known::yes) known = Known::lost;
    }
    state.lost_line = line;
}

// The tool's axis in the stock.
Vec3 tool_axis(const State& state, const Output& output) {
    if (!output.machine) return turned(state.rotary.now_axis, state.active().turn_deg);
    return output.machine->kinematics().axis(state.rotary.now_rad);
}

Result<Vec3> read_origin(Command& command, State& state, Output& output) {
    Vec3 origin;
    for (int axis = 0; axis < 3; ++axis) {
        const auto word = coordinate_mm(command, axis, state, output);
        if (!word) return std::unexpected(word.error());
        if (*word) origin[axis] = **word;
    }
    command.hide_axes();
    return origin;
}

// I J K in degrees.
Result<std::array<double, 3>> read_angles(Command& command, const Output& output) {
    std::array<double, 3> angles{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Word* word = command.use("IJK"[i]);
        if (word == nullptr) continue;
        if (auto good = in_range(kLimits.rotary_angle, word->value, command, *word, output); !good)
            return std::unexpected(good.error());
        angles[i] = word->value * math::kRadPerDeg;
    }
    return angles;
}

// The order of turns, such as 123: axes 0 to 2.
Result<std::array<int, 3>> read_order(Command& command, int usual, Code code, const Output& output) {
    const Word* word = command.use('Q');
    const double number = word == nullptr ? usual : word->value;
    constexpr std::array orders{123, 132, 213, 231, 312, 321};
    for (const int order : orders) {
        if (number == order) return std::array{order / 100 - 1, order / 10 % 10 - 1, order % 10 - 1};
    }
    return output.refuse(command.line(), word == nullptr ? code.column : word->column,
                         "Q is no order of the axes 1, 2 and 3", "write for example Q123");
}

constexpr Vec3 kAxes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

// Roll, pitch and yaw: turns about the axes of the work, one after the other.
Result<motion::WorkFrame> turned_in_order(Command& command, motion::WorkFrame frame, int usual, Code code,
                                          Output& output) {
    const auto order = read_order(command, usual, code, output);
    if (!order) return std::unexpected(order.error());
    const auto angles = read_angles(command, output);
    if (!angles) return std::unexpected(angles.error());
    // Turns about fixed axes are those about the turned axes in the reverse order.
    for (std::size_t i = 3; i-- > 0;) {
        const int axis = (*order)[i];
        frame = frame.turned(kAxes[axis], (*angles)[static_cast<std::size_t>(axis)]);
    }
    if (output.first(Note::roll_pitch_yaw)) {
        output.warn(command.line(), code_text('G', code.tenths) +
                                        ": the angles I, J and K are taken about the fixed axes X, Y and Z "
                                        "of the work, in the order of Q");
    }
    return frame;
}

// The frame at the origin with a direction of its z, and one near its x.
std::optional<motion::WorkFrame> frame_of(Vec3 origin, Vec3 x, Vec3 z) {
    const Vec3 y = cross(z, x);
    if (!(length(z) > 1e-9) || !(length(y) > 1e-6 * length(z) * length(x))) return std::nullopt;
    motion::WorkFrame frame;
    frame.origin_mm = origin;
    frame.z = normalized(z);
    frame.y = normalized(y);
    frame.x = cross(frame.y, frame.z);
    return frame;
}

// P4: X turned about Y by I, and Y turned about X by J, lie in the plane; X turns in it by K.
Result<motion::WorkFrame> plane_of_projections(Command& command, const motion::WorkFrame& frame, Code code,
                                               Output& output) {
    const auto angles = read_angles(command, output);
    if (!angles) return std::unexpected(angles.error());
    const double i = (*angles)[0], j = (*angles)[1];
    const Vec3 a = math::cos(i) * frame.x - math::sin(i) * frame.z;
    const Vec3 b = math::cos(j) * frame.y + math::sin(j) * frame.z;
    const auto plane = frame_of(frame.origin_mm, a, cross(a, b));
    if (!plane) {
        return output.refuse(command.line(), code.column, "the projection angles of G68.2 P4 give no plane",
                             "correct I and J");
    }
    if (output.first(Note::projection_angles)) {
        output.warn(command.line(),
                    "G68.2 P4: X turned about Y by I and Y turned about X by J are taken as the "
                    "directions of the plane");
    }
    return plane->turned(kAxes[2], (*angles)[2]);
}

// Keeps a block of G68.2 P2 (three points: the origin, one on X, one on the side of Y) or P3 (Q1: origin and
// X, Q2: Z). Returns true if the blocks of the plane are complete.
Result<bool> keep_plane_block(Command& command, State& state, Output& output, int kind) {
    const Word* q = command.use('Q');
    const int most = kind == 2 ? 3 : 2;
    const double number = q == nullptr ? -1 : q->value;
    if (!(number >= (kind == 2 ? 0 : 1)) || number > most || number != std::floor(number)) {
        return output.refuse(command.line(), q == nullptr ? 1 : q->column,
                             "G68.2 P" + std::to_string(kind) + " without Q1 to Q" + std::to_string(most),
                             "write which part of the plane the block states");
    }
    const auto at = static_cast<std::size_t>(number);
    PlaneBlocks& blocks = state.plane_blocks;
    if (blocks.kind != kind || blocks.points[at]) blocks = {};
    blocks.kind = kind;
    const auto point = read_origin(command, state, output);
    if (!point) return std::unexpected(point.error());
    blocks.points[at] = *point;
    Vec3 direction;
    for (int k = 0; k < 3; ++k) {
        if (const Word* word = command.use("IJK"[k])) direction[k] = word->value;
    }
    blocks.directions[at] = direction;
    const Word* turn = command.use('R');
    if (at == 0 && (length(*point) > 0 || (turn != nullptr && turn->value != 0))) {
        return output.refuse(command.line(), q->column, "a shift or a turn in Q0 of G68.2 P2 is not read",
                             "let the CAM system write the plane by its angles I J K");
    }
    for (int k = 1; k <= most; ++k) {
        if (!blocks.points[static_cast<std::size_t>(k)]) return false;
    }
    return true;
}

Result<motion::WorkFrame> plane_of_blocks(const Command& command, const State& state, Code code,
                                          const Output& output) {
    const PlaneBlocks& blocks = state.plane_blocks;
    const int kind = blocks.kind;
    const motion::WorkFrame base = work_frame(state);
    const Vec3 origin = base.in_stock(*blocks.points[1]);
    const Vec3 x = kind == 2 ? base.in_stock(*blocks.points[2]) - origin
                             : base.direction_in_stock(*blocks.directions[1]);
    const Vec3 z = kind == 2 ? cross(x, base.in_stock(*blocks.points[3]) - origin)
                             : base.direction_in_stock(*blocks.directions[2]);
    const auto plane = frame_of(origin, x, z);
    if (!plane) {
        return output.refuse(command.line(), code.column,
                             kind == 2 ? "the points of G68.2 P2 lie on one line"
                                       : "the vectors of G68.2 P3 have no directions of their own",
                             "correct them");
    }
    return *plane;
}

// G68.2: Euler's angles about Z, X and Z. P1: roll, pitch and yaw. P4: projection angles.
Result<motion::WorkFrame> plane_of_angles(Command& command, const motion::WorkFrame& frame, Code code,
                                          Output& output) {
    const Word* kind = command.use('P');
    if (kind != nullptr && kind->value == 1) return turned_in_order(command, frame, 123, code, output);
    if (kind != nullptr && kind->value == 4) return plane_of_projections(command, frame, code, output);
    if (kind != nullptr && kind->value != 0) {
        return output.refuse(command.line(), kind->column, "G68.2 is read with P0 to P4",
                             "let the CAM system write the plane by its angles I J K");
    }
    const auto angles = read_angles(command, output);
    if (!angles) return std::unexpected(angles.error());
    return frame.turned(kAxes[2], (*angles)[0]).turned(kAxes[0], (*angles)[1]).turned(kAxes[2], (*angles)[2]);
}

// G68 about an axis I J K in space, by R degrees.
Result<motion::WorkFrame> plane_about_axis(Command& command, const motion::WorkFrame& frame, Code code,
                                           Output& output) {
    Vec3 axis;
    for (int i = 0; i < 3; ++i) {
        if (const Word* word = command.use("IJK"[i])) axis[i] = word->value;
    }
    const Word* angle = command.use('R');
    if (!(length(axis) > 1e-6) || angle == nullptr) {
        return output.refuse(command.line(), code.column,
                             "G68 in space without the direction I J K of its axis, or without its angle R",
                             "write both");
    }
    if (auto good = in_range(kLimits.rotary_angle, angle->value, command, *angle, output); !good)
        return std::unexpected(good.error());
    return frame.turned(normalized(axis), angle->value * math::kRadPerDeg);
}

// G68.3: normal to the tool as it stands; X is level, then turned by R (Fanuc 30i, Z vertical).
Result<motion::WorkFrame> plane_of_tool(Command& command, motion::WorkFrame frame, const State& state,
                                        const Output& output) {
    const Vec3 z = tool_axis(state, output);
    const Vec3 level = cross(frame.z, z);
    if (length(level) > 1e-9) {
        frame.x = normalized(level);
        frame.z = z;
        frame.y = cross(frame.z, frame.x);
    }
    const Word* angle = command.use('R');
    if (angle == nullptr) return frame;
    if (auto good = in_range(kLimits.rotary_angle, angle->value, command, *angle, output); !good)
        return std::unexpected(good.error());
    return frame.turned(kAxes[2], angle->value * math::kRadPerDeg);
}

// The plane that one block describes, in the work system or in the plane before.
Result<motion::WorkFrame> plane_of_block(Command& command, const State& state, Code code, Vec3 origin,
                                         Output& output) {
    const motion::WorkFrame base =
        (state.tilt ? state.tilt->frame.shifted(state.origin_mm()) : work_frame(state)).shifted(origin);
    if (code.tenths == 680) return plane_about_axis(command, base, code, output);
    if (code.tenths == 682) return plane_of_angles(command, base, code, output);
    if (code.tenths == 2680) return turned_in_order(command, base, 321, code, output);
    return plane_of_tool(command, base, state, output);
}

}  // namespace

bool begins_tilted_plane(const Command& command, Code rotation) {
    if (rotation.tenths == 682 || rotation.tenths == 683 || rotation.tenths == 2680) return true;
    return rotation.tenths == 680 && command.has_any("IJK");
}

Result<void> begin_tilted_plane(Command& command, State& state, Output& output, Code code) {
    if (!state.frame.is_plain()) {
        return output.refuse(command.line(), code.column,
                             "a tilted plane in coordinates that are turned, scaled, mirrored or polar",
                             "end G16, G51, G51.1 and G68 before it");
    }
    const std::optional<Vec3> tip = tip_in_stock(state, output);
    const auto hide_words = [&] {
        for (const char letter : {'I', 'J', 'K', 'R', 'P', 'Q'}) command.hide(letter);
    };
    const Word* kind = code.tenths == 682 ? command.use('P') : nullptr;
    const bool is_of_blocks = kind != nullptr && (kind->value == 2 || kind->value == 3);
    Vec3 origin;
    if (is_of_blocks) {
        const auto complete = keep_plane_block(command, state, output, static_cast<int>(kind->value));
        if (!complete) return std::unexpected(complete.error());
        if (!*complete) {
            hide_words();
            return {};
        }
    } else {
        state.plane_blocks = {};
        const auto read = read_origin(command, state, output);
        if (!read) return std::unexpected(read.error());
        origin = *read;
    }
    // A second G68 counts in the first one; the others replace it.
    const bool adds = code.tenths == 680 && state.tilt;
    if (state.tilt && !adds) end_tilted_plane(state, output, command.line());
    const auto plane = is_of_blocks ? plane_of_blocks(command, state, code, output)
                                    : plane_of_block(command, state, code, origin, output);
    if (!plane) return std::unexpected(plane.error());
    hide_words();
    if (!adds) {
        state.tilt.emplace();
        state.tilt->preset_before_mm = state.preset_mm;
    }
    state.preset_mm = {};
    state.tilt->frame = *plane;
    if (plane->is_tilted() && state.parallel.at_mm != Vec3{})
        output.warn(command.line(), MachineRun::kParallelInTiltedPlane);
    state.tilt->about_axis = code.tenths == 680;
    if (tip) state.tip_mm = plane->from_stock(*tip);
    if (!tip) lose_tip(state, command.line());
    // No code turns the tool to a plane of G68: the rotary words do, which mean nothing without a machine.
    if (state.tilt->about_axis && !output.machine) return turn_tool_to_plane(command, state, output, code);
    return {};
}

void end_tilted_plane(State& state, Output& output, int line) {
    if (!state.tilt) return;
    const std::optional<Vec3> tip = tip_in_stock(state, output);
    state.preset_mm = state.tilt->preset_before_mm;
    state.tilt.reset();
    RotaryState& rotary = state.rotary;
    if (!output.machine) {
        const bool swings = distance(rotary.now_axis, {0, 0, 1}) > kSameDirection;
        rotary.now_axis = rotary.target_axis = {0, 0, 1};
        if (tip && !swings) state.tip_mm = turned(*tip, -state.active().turn_deg);
        if (!tip || swings) lose_tip(state, line);
        return;
    }
    if (!tip || (!rotary.tip_control && output.machine->needs_tool_length(rotary.now_rad))) {
        lose_tip(state, line);
        return;
    }
    const motion::Kinematics& kinematics = output.machine->kinematics();
    const Vec3 place = rotary.tip_control
                           ? *tip
                           : kinematics.with_tip(*tip, rotary.now_rad).linear_mm - kinematics.stock_mm();
    state.tip_mm = turned(place, -state.active().turn_deg);
}

Result<void> turn_tool_to_plane(Command& command, State& state, Output& output, Code code) {
    command.use('P');
    if (!state.tilt) {
        if (output.first(Note::empty_code, code.tenths)) {
            output.warn(command.line(),
                        code_text('G', code.tenths) + " without a tilted plane turns nothing");
        }
        return {};
    }
    const bool keeps_tip = code.tenths == 536;
    const Vec3 axis = state.tilt->frame.z;
    RotaryState& rotary = state.rotary;
    if (!output.machine) {
        const Vec3 target = turned(axis, -state.active().turn_deg);
        const bool swings = distance(rotary.now_axis, target) > kSameDirection;
        rotary.now_axis = rotary.target_axis = target;
        if (swings && !keeps_tip) lose_tip(state, command.line());
        return {};
    }
    const motion::Kinematics& kinematics = output.machine->kinematics();
    const auto reached = kinematics.joints({{}, axis}, {{}, rotary.now_rad});
    if (!reached) {
        return output.refuse(
            command.line(), code.column,
            "the machine " + output.machine->machine().name + " cannot turn its tool normal to this plane",
            "name the machine that the program is written for");
    }
    const Vec3 from_rad = rotary.now_rad;
    rotary.now_rad = rotary.target_rad = reached->joints.rotary_rad;
    if (keeps_tip || rotary.now_rad == from_rad || !state.knows_tip()) return {};
    if (output.machine->needs_tool_length(from_rad) || output.machine->needs_tool_length(rotary.now_rad)) {
        lose_tip(state, command.line());
        return {};
    }
    const Vec3 linear = kinematics.with_tip(state.tilt->frame.in_stock(state.tip_mm), from_rad).linear_mm;
    state.tip_mm = state.tilt->frame.from_stock(kinematics.pose({linear, rotary.now_rad}).tip_mm);
    return {};
}

motion::Move in_stock(const motion::Move& move, const State& state) {
    if (!state.tilt) return turned(move, state.active().turn_deg);
    const motion::WorkFrame& frame = state.tilt->frame;
    motion::Move result = move;
    for (motion::ToolPose* pose : {&result.start, &result.end}) {
        pose->tip_mm = frame.in_stock(pose->tip_mm);
        pose->axis = turned(pose->axis, state.active().turn_deg);
    }
    if (result.arc) {
        result.arc->centre_mm = frame.in_stock(result.arc->centre_mm);
        result.arc->normal = frame.direction_in_stock(result.arc->normal);
    }
    if (result.quadratic) {
        result.quadratic->tip_control_mm = frame.in_stock(result.quadratic->tip_control_mm);
        result.quadratic->axis_control = turned(result.quadratic->axis_control, state.active().turn_deg);
    }
    return result;
}

}  // namespace tribo::readers::gcode
