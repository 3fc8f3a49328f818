// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/motion.hpp"

#include <cmath>

#include "readers/gcode/motion/arc.hpp"
#include "readers/gcode/motion/cycles.hpp"
#include "readers/gcode/motion/moves.hpp"
#include "readers/gcode/motion/rotary.hpp"
#include "readers/gcode/motion/splines.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr char kAxisLetters[] = "XYZ";
constexpr char kCentreLetters[] = "IJK";
constexpr double kMostExtraTurns = 10'000;

Result<int> extra_turns(Command& command, const Output& output) {
    const Word* turns = command.use('P');
    if (turns == nullptr) return 0;
    if (turns->value < 1 || turns->value > kMostExtraTurns || turns->value != std::floor(turns->value)) {
        return output.refuse(command.line(), turns->column,
                             "the number of turns P is not a whole number above 0", "correct P");
    }
    return static_cast<int>(turns->value) - 1;
}

// Returns the arc from the tip to the target.
Result<motion::Arc> arc_of(Command& command, const State& state, Vec3 target, const Output& output) {
    ArcEnds ends;
    ends.plane = state.plane;
    ends.clockwise = state.motion == MotionMode::arc_clockwise;
    ends.start_mm = state.tip_mm;
    ends.end_mm = target;
    const auto turns = extra_turns(command, output);
    if (!turns) return std::unexpected(turns.error());
    ends.extra_turns = *turns;

    const auto placed = [&](Result<motion::Arc> arc, int column) -> Result<motion::Arc> {
        if (arc) return arc;
        return output.refuse(command.line(), column, arc.error().cause, arc.error().remedy);
    };
    const auto axes = axes_of(state.plane);
    const char first = kCentreLetters[axes[0]], second = kCentreLetters[axes[1]];
    if (command.has(kCentreLetters[axes[2]])) {
        const Word* word = command.use(kCentreLetters[axes[2]]);
        return output.refuse(command.line(), word->column,
                             std::string("an arc in this plane has no use for ") + word->letter,
                             "select the plane with G17, G18 or G19, or delete the word");
    }
    if (const Word* radius = command.use('R')) {
        if (command.has(first) || command.has(second)) {
            return output.refuse(command.line(), radius->column, "the arc has a radius and a centre",
                                 std::string("delete R, or ") + first + " and " + second);
        }
        const double radius_mm = radius->value * state.unit_mm;
        if (auto good = in_range(kLimits.coordinate, radius_mm, command, *radius, output); !good)
            return std::unexpected(good.error());
        return placed(arc_of_radius(ends, radius_mm), radius->column);
    }
    Vec3 centre = state.absolute_centres ? state.origin_mm() : state.tip_mm;
    int column = 0, given = 0;
    for (int i = 0; i < 2; ++i) {
        const Word* word = command.use(kCentreLetters[axes[static_cast<std::size_t>(i)]]);
        if (word == nullptr) continue;
        const double offset_mm = word->value * state.unit_mm;
        if (auto good = in_range(kLimits.coordinate, offset_mm, command, *word, output); !good)
            return std::unexpected(good.error());
        centre[axes[static_cast<std::size_t>(i)]] += offset_mm;
        if (column == 0 || word->column < column) column = word->column;
        ++given;
    }
    if (given == 0 || (given == 1 && state.absolute_centres)) {
        return output.refuse(command.line(), given == 0 ? column_of_any(command, "XYZ") : column,
                             given == 0 ? "an arc without centre or radius"
                                        : std::string("an arc in absolute centres (G90.1) needs both ") +
                                              first + " and " + second,
                             std::string("add ") + first + " and " + second + (given == 0 ? ", or R" : ""));
    }
    return placed(arc_about_centre(ends, centre, state.unit_mm), column);
}

Result<void> move_at_feed(Command& command, State& state, Output& output) {
    if (auto known = require_start(command, state, output); !known) return known;
    const auto target = target_of(command, state, output);
    if (!target) return std::unexpected(target.error());

    motion::Move move = new_move(motion::MoveKind::feed, command, state);
    move.end.tip_mm = target->tip_mm;
    if (state.motion != MotionMode::line) {
        auto arc = arc_of(command, state, target->tip_mm, output);
        if (!arc) return std::unexpected(arc.error());
        move.arc = *arc;
    }
    if (auto fed = set_feed(move, command, state, output); !fed) return fed;
    set_turning_time(move, state);
    note_spindle(command, state, output);
    const bool stays =
        !move.arc && move.start.tip_mm == move.end.tip_mm && !state.rotary.turns() && !state.left_at_mm;
    state.tip_mm = target->tip_mm;
    return stays ? Result<void>{} : append(move, state, output);
}

// G53: coordinates relative to the zero of the machine, which is unknown to the program.
Result<void> move_to_machine_position(Command& command, State& state, Output& output, int column) {
    if (state.motion != MotionMode::rapid) {
        return output.refuse(command.line(), column,
                             "G53 (machine coordinates) with a feed move is not read yet",
                             "write the move in the coordinates of the work, or as a rapid (G0)");
    }
    if (state.incremental) {
        return output.refuse(command.line(), column, "G53 (machine coordinates) does not go with G91",
                             "write G90 before it");
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (command.use(kAxisLetters[axis]) == nullptr) continue;
        state.known[static_cast<std::size_t>(axis)] = Known::lost;
        state.lost_line = command.line();
    }
    if (output.first(Note::machine_position)) {
        output.warn(
            command.line(),
            "G53 goes to a place that only the machine knows: the path is left out until X, Y and Z are "
            "known again");
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
    const bool moves = command.has_any("XYZ") || (turns && command.has_any("IJKR")) || state.rotary.stated;
    if (command.has_g(GGroup::non_modal, 530) && (command.has_any("XYZ") || !state.rotary.stated)) {
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
    if (repeats_cycle(command, state)) return run_cycle(command, state, output);
    if (!moves) return {};
    if (state.motion == MotionMode::none) {
        return output.refuse(command.line(), column_of_any(command, "XYZABC"),
                             "coordinates without a motion code in force",
                             "write G0, G1, G2 or G3 on this line or before it");
    }
    return state.motion == MotionMode::rapid ? move_rapidly(command, state, output)
                                             : move_at_feed(command, state, output);
}

Result<void> dwell(double seconds, const Command& command, State& state, Output& output) {
    if (!state.knows_tip() || seconds == 0) return {};
    motion::Move move = new_move(motion::MoveKind::dwell, command, state);
    move.duration_s = seconds;
    return append(move, state, output);
}

}  // namespace tribo::readers::gcode
