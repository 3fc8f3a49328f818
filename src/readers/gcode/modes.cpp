// SPDX-License-Identifier: MIT
#include "readers/gcode/modes.hpp"

#include <cmath>

#include "readers/gcode/motion/compensation.hpp"
#include "readers/gcode/motion/cycles.hpp"
#include "readers/gcode/motion/moves.hpp"
#include "readers/gcode/motion/rotary.hpp"

namespace tribo::readers::gcode {
namespace {

const Limit& feed_limit(FeedMode mode) {
    return mode == FeedMode::inverse_time ? kLimits.inverse_time
           : mode == FeedMode::per_minute ? kLimits.feed
                                          : kLimits.feed_per_turn;
}

void set_units(const Command& command, State& state) {
    const auto code = command.g(GGroup::units);
    if (!code) return;
    state.unit_mm = mm_per(code->tenths == 200 ? LengthUnit::inch : LengthUnit::millimetre);
    state.unit_stated = true;
}

Result<void> set_feed(Command& command, State& state, const Output& output) {
    if (const auto code = command.g(GGroup::feed_mode)) {
        const FeedMode mode = code->tenths == 930   ? FeedMode::inverse_time
                              : code->tenths == 940 ? FeedMode::per_minute
                                                    : FeedMode::per_turn;
        // The value of F has no meaning in another feed mode.
        if (mode != state.feed_mode) state.feed.reset();
        state.feed_mode = mode;
    }
    const Word* word = command.use('F');
    if (word == nullptr) return {};
    const double value =
        state.feed_mode == FeedMode::inverse_time ? word->value : word->value * state.unit_mm;
    // A feed of 0 is refused where a move uses it.
    if (value != 0) {
        if (auto good = in_range(feed_limit(state.feed_mode), value, command, *word, output); !good)
            return good;
    }
    state.feed = value;
    state.feed_line = command.line();
    return {};
}

Result<void> set_spindle(Command& command, State& state, const Output& output) {
    if (const Word* word = command.use('S')) {
        if (word->value != 0) {
            if (auto good = in_range(kLimits.spindle_speed, word->value, command, *word, output); !good)
                return good;
        }
        state.spindle_rpm = word->value;
        state.spindle_stands = word->value == 0;
    }
    if (const auto code = command.m(MGroup::spindle)) {
        state.spindle = code->tenths == 30   ? Spindle::clockwise
                        : code->tenths == 40 ? Spindle::counter_clockwise
                                             : Spindle::off;
    }
    return {};
}

Result<void> set_tool(Command& command, State& state, Output& output) {
    if (const Word* word = command.use('T')) {
        if (word->value != 0) {
            if (auto good = in_range(kLimits.tool_number, word->value, command, *word, output); !good)
                return good;
        }
        if (word->value != std::floor(word->value)) {
            return output.refuse(command.line(), word->column, "the tool number is not a whole number",
                                 "correct T");
        }
        state.selected_tool = static_cast<int>(word->value);
    }
    if (command.m(MGroup::tool)) {
        state.loaded_tool = state.selected_tool;
        state.has_changed_tool = true;
    }
    if (output.machine && (command.m(MGroup::tool) || command.has('T'))) {
        output.machine->set_tool_length(output.tool_length_mm(state.tool()));
    }
    return {};
}

Result<void> set_tool_length(Command& command, Output& output) {
    const auto code = command.g(GGroup::tool_length);
    if (!code || code->tenths == 490 || code->tenths == 1680) return {};
    if (code->tenths == 431) {
        if (command.g(GGroup::motion) || command.has_any("XY")) {
            return output.refuse(command.line(), code->column,
                                 "G43.1 with a motion, or with an offset across the tool, is not read",
                                 "write the length as Z in a block of its own");
        }
        command.use('Z');
        command.hide_axes();
    }
    const Word* offset = command.use('H');
    if (offset != nullptr && offset->value < 0) {
        return output.refuse(command.line(), offset->column, "the tool length number is negative",
                             "correct H");
    }
    if (output.first(Note::tool_length)) {
        output.warn(command.line(),
                    code_text('G', code->tenths) +
                        ": the tool's length is taken as measured right, so that coordinates name its tip");
    }
    return {};
}

void set_work_system(const Command& command, State& state, Output& output) {
    const auto code = command.g(GGroup::work_offset);
    if (!code) return;
    const int tenths = code->tenths;
    const double before_deg = state.active().turn_deg;
    state.active_work = tenths <= 590 ? (tenths - 540) / 10 : 5 + tenths - 590;
    state.reframe(before_deg);
    const bool unset = state.active_work != 0 && !state.work[static_cast<std::size_t>(state.active_work)].set;
    if (unset && output.first(Note::work_system)) {
        output.warn(command.line(),
                    code_text('G', tenths) +
                        ": the program does not say where this work system lies; its origin is taken as the "
                        "stock's");
    }
}

void set_motion_mode(Command& command, State& state, const Output& output) {
    const auto code = command.g(GGroup::motion);
    if (!code) return;
    if (output.options.dialect == GcodeDialect::fanuc && (code->tenths == 50 || code->tenths == 51)) {
        for (const char letter : {'P', 'Q', 'R', 'X', 'Y', 'Z'}) command.use(letter);
        command.hide_axes();  // look-ahead and smoothing are ignored
        return;
    }
    if (code->tenths != 50) state.spline_end_mm.reset();
    switch (code->tenths) {
        case 0:
            state.motion = MotionMode::rapid;
            break;
        case 10:
            state.motion = MotionMode::line;
            break;
        case 20:
            state.motion = MotionMode::arc_clockwise;
            break;
        case 30:
            state.motion = MotionMode::arc_counter_clockwise;
            break;
        case 50:
            state.motion = MotionMode::cubic_spline;
            break;
        case 51:
            state.motion = MotionMode::quadratic_spline;
            break;
        case 52:
            state.motion = MotionMode::nurbs;
            break;
        case 62:
            state.motion = MotionMode::nurbs_with_knots;
            break;
        case 53:
        case 800:
            state.motion = MotionMode::none;
            break;
        default:
            begin_cycle(*code, state);
            break;
    }
}

}  // namespace

Result<void> apply_modes(Command& command, State& state, Output& output) {
    set_units(command, state);
    if (auto done = set_feed(command, state, output); !done) return done;
    if (auto done = set_spindle(command, state, output); !done) return done;
    if (auto done = set_tool(command, state, output); !done) return done;
    if (const auto code = command.g(GGroup::plane)) {
        state.plane = code->tenths == 170 ? Plane::xy : code->tenths == 180 ? Plane::zx : Plane::yz;
    }
    if (auto done = set_tool_length(command, output); !done) return done;
    set_work_system(command, state, output);
    if (auto done = begin_compensation(command, state, output); !done) return done;
    if (const auto code = command.g(GGroup::path_control); code && code->tenths == 640) {
        command.use('P');  // tolerance for rounded corners; it is ignored
        command.use('Q');
    }
    if (command.m(MGroup::outputs) || command.m(MGroup::overrides) || command.m(MGroup::orientation)) {
        for (const char letter : {'P', 'Q', 'E'}) command.use(letter);
        if (command.m(MGroup::orientation) && !command.g(GGroup::motion)) command.use('R');
    }
    if (const auto code = command.g(GGroup::distance)) state.incremental = code->tenths == 910;
    if (const auto code = command.g(GGroup::arc_distance)) state.absolute_centres = code->tenths == 901;
    if (const auto code = command.g(GGroup::return_level)) {
        state.retract_to_r = code->tenths == 990;
        state.return_level_stated = true;
    }
    set_motion_mode(command, state, output);
    return switch_tip_control(command, state, output);
}

}  // namespace tribo::readers::gcode
