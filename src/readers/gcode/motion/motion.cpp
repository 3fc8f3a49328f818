// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/motion.hpp"

#include <cmath>

#include "readers/gcode/frames/cylinder.hpp"
#include "readers/gcode/motion/arc_words.hpp"
#include "readers/gcode/motion/circular_pocket.hpp"
#include "readers/gcode/motion/corners.hpp"
#include "readers/gcode/motion/cycles.hpp"
#include "readers/gcode/motion/moves.hpp"
#include "readers/gcode/motion/parallel_axes.hpp"
#include "readers/gcode/motion/rotary.hpp"
#include "readers/gcode/motion/splines.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr char kAxisLetters[] = "XYZ";
// An arc whose ends are closer is a point, mm.
constexpr double kPointMm = 1e-6;

// A feed move from a place that only the machine knows: the tool is at its end afterwards.
Result<void> leave_out(Command& command, State& state, Output& output) {
    const auto target = target_of(command, state, output);
    if (!target) return std::unexpected(target.error());
    for (const char letter : {'I', 'J', 'K', 'R', 'P'}) command.use(letter);
    state.tip_mm = target->tip_mm;
    state.known = target->known;
    output.leave_out(command.line(), state.lost_line);
    return {};
}

// An axis that the program never names stays where it is, wherever the machine has sent it: it counts as
// unstated.
void forget_unnamed_axes(State& state, Output& output) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (state.known[axis] == Known::lost && !output.writes_axis(axis))
            state.known[axis] = Known::unstated;
    }
}

Result<void> move_at_feed(Command& command, State& state, Output& output) {
    if (state.has_lost_tip()) forget_unnamed_axes(state, output);
    if (state.has_lost_tip()) return leave_out(command, state, output);
    if (auto known = require_start(command, state, output); !known) return known;
    const auto target = target_of(command, state, output);
    if (!target) return std::unexpected(target.error());

    if (state.cylinder) return feed_on_cylinder(command, state, target->tip_mm, output);
    const auto corner = corner_of(command, state, output);
    if (!corner) return std::unexpected(corner.error());
    motion::Move move = new_move(motion::MoveKind::feed, command, state);
    move.end.tip_mm = target->tip_mm;
    if (state.motion != MotionMode::line) {
        auto arc = arc_of(command, state, target->tip_mm, output);
        if (!arc) return std::unexpected(arc.error());
        if (!*arc && distance(move.start.tip_mm, move.end.tip_mm) <= kPointMm) return {};
        move.arc = *arc;
    }
    if (auto fed = set_feed(move, command, state, output); !fed) return fed;
    set_turning_time(move, state, output);
    note_spindle(command, state, output);
    const bool stays =
        !move.arc && move.start.tip_mm == move.end.tip_mm && !state.rotary.turns() && !state.left_at_mm;
    state.tip_mm = target->tip_mm;
    if (stays) return {};
    if (!*corner) return append(move, state, output);
    // A move that begins behind a corner is known only when it is output.
    if (state.corner) return join_at_corner(move, state, output, *corner);
    return wait_for_corner(move, **corner, state, output);
}

// G53: coordinates relative to the zero of the machine, which is unknown to the program.
Result<void> move_to_machine_position(Command& command, State& state, Output& output, int column) {
    if (!command.has_any("XYZUVW")) {
        if (output.first(Note::empty_code, 530)) {
            output.warn(command.line(), "G53 without coordinates moves nothing");
        }
        return {};
    }
    // Fanuc controls ignore G53 in G91 or move, by the control; where the tool is then, only the machine
    // knows.
    if (state.incremental && output.options.dialect != GcodeDialect::fanuc) {
        return output.refuse(command.line(), column, "G53 (machine coordinates) does not go with G91",
                             "write G90 before it");
    }
    const bool is_oblique = state.tilt && state.tilt->frame.is_tilted();
    for (int axis = 0; axis < 3; ++axis) {
        const bool goes = command.use(kAxisLetters[axis]) != nullptr || command.use("UVW"[axis]) != nullptr;
        if (!goes && !is_oblique) continue;
        state.known[static_cast<std::size_t>(axis)] = Known::lost;
        state.lost_line = command.line();
    }
    home_parallel_axes(command, state);
    if (output.first(Note::machine_position)) {
        output.warn(
            command.line(),
            "G53 goes to a place that only the machine knows: the path is left out until X, Y and Z are "
            "known again");
    }
    return {};
}

// Coordinates after G80, or before any motion code.
void assume_motion(const Command& command, State& state, Output& output) {
    if (state.plain_motion != MotionMode::none) {
        state.motion = state.plain_motion;
        if (output.first(Note::motion_after_cycle)) {
            output.warn(command.line(),
                        "coordinates without a motion code after the end of a cycle: the last of G0 to G3 "
                        "goes on, as "
                        "on Fanuc controls");
        }
        return;
    }
    state.motion = state.plain_motion = MotionMode::rapid;
    if (output.first(Note::motion_assumed)) {
        output.warn(
            command.line(),
            "coordinates before any motion code: a rapid (G0) is taken, in which most controls begin");
    }
}

// G33.1: to the end and back, K for each turn of the spindle (LinuxCNC).
Result<void> tap_rigidly(Command& command, State& state, Output& output, Code code) {
    const Word* pitch = command.use('K');
    const double feed = pitch == nullptr ? 0 : std::abs(pitch->value) * state.unit_mm * state.spindle_rpm;
    if (!(feed > 0) || !kLimits.feed.range.contains(feed)) {
        return output.refuse(command.line(), code.column, "G33.1 without a pitch K, or without a speed S",
                             "write K in this block and S before it");
    }
    if (state.has_lost_tip()) return leave_out(command, state, output);
    if (auto known = require_start(command, state, output); !known) return known;
    const auto target = target_of(command, state, output);
    if (!target) return std::unexpected(target.error());
    const Vec3 start = state.tip_mm;
    for (const Vec3 to : {target->tip_mm, start}) {
        motion::Move move = new_move(motion::MoveKind::feed, command, state);
        move.end.tip_mm = to;
        move.feed_mm_per_min = feed;
        if (move.start.tip_mm == to) continue;
        state.tip_mm = to;
        if (auto done = append(move, state, output); !done) return done;
    }
    return {};
}

}  // namespace

Result<void> move_rapidly(Command& command, State& state, Output& output) {
    const auto target = target_of(command, state, output);
    if (!target) return std::unexpected(target.error());
    motion::Move move = new_move(motion::MoveKind::rapid, command, state);
    const bool known = state.knows_tip();
    state.tip_mm = target->tip_mm;
    state.known = target->known;
    move.end.tip_mm = state.tip_mm;
    if (!known || !state.knows_tip()) return {};
    if (move.start.tip_mm == move.end.tip_mm && !state.rotary.turns() && !state.left_at_mm) return {};
    return append(move, state, output);
}

Result<void> apply_motion(Command& command, State& state, Output& output) {
    const bool turns =
        state.motion == MotionMode::arc_clockwise || state.motion == MotionMode::arc_counter_clockwise;
    const bool moves = command.has_any("XYZ") || (turns && command.has_any("IJKR")) || state.rotary.stated ||
                       has_parallel_move(command, state);
    if (command.has_g(GGroup::non_modal, 530) && (command.has_any("XYZUVW") || !state.rotary.stated)) {
        return move_to_machine_position(command, state, output, command.g(GGroup::non_modal)->column);
    }
    if (command.has_g(GGroup::motion, 53)) {
        if (state.nurbs.runs) return finish_nurbs(state, output);
        return output.refuse(command.line(), command.g(GGroup::motion)->column,
                             "G5.3 ends a B-spline that nothing has begun", "begin it with G5.2");
    }
    if (state.motion == MotionMode::nurbs || state.motion == MotionMode::nurbs_with_knots) {
        const bool adds = command.g(GGroup::motion) || command.has_any("XYZPRKL");
        return adds ? add_to_nurbs(command, state, output) : Result<void>{};
    }
    if (moves && (state.motion == MotionMode::cubic_spline || state.motion == MotionMode::quadratic_spline)) {
        return run_bezier(command, state, output);
    }
    if (const auto pocket = command.g(GGroup::round_pocket)) {
        return mill_round_pocket(command, state, output, *pocket);
    }
    if (const auto tap = command.g(GGroup::rigid_tap)) return tap_rigidly(command, state, output, *tap);
    if (repeats_cycle(command, state)) return run_cycle(command, state, output);
    if (!moves) return {};
    if (state.motion == MotionMode::none) assume_motion(command, state, output);
    return state.motion == MotionMode::rapid ? move_rapidly(command, state, output)
                                             : move_at_feed(command, state, output);
}

double dwell_s(const Word& p, const Output& output) {
    const bool in_milliseconds = output.options.dialect == GcodeDialect::fanuc && !p.has_point;
    return in_milliseconds ? p.value / 1000 : p.value;
}

Result<void> dwell(double seconds, const Command& command, State& state, Output& output) {
    if (!state.knows_tip() || seconds == 0) return {};
    motion::Move move = new_move(motion::MoveKind::dwell, command, state);
    move.duration_s = seconds;
    return append(move, state, output);
}

}  // namespace tribo::readers::gcode
