// SPDX-License-Identifier: MIT
#include "readers/gcode/modes.hpp"

#include <cmath>

#include "readers/gcode/frames/cylinder.hpp"
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
    const bool is_inch = code->tenths == 200 || code->tenths == 700;
    state.unit_mm = mm_per(is_inch ? LengthUnit::inch : LengthUnit::millimetre);
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

// S of G4 is a time (Marlin), S of G50 the largest speed of a lathe.
bool is_speed(const Command& command) {
    const bool is_dwell = command.has_g(GGroup::non_modal, 40) && !command.has_any("PXU");
    return !is_dwell && !command.has_g(GGroup::scaling, 500);
}

Result<void> set_spindle(Command& command, State& state, Output& output) {
    if (is_speed(command) && command.has('S')) {
        const Word* word = command.use('S');
        if (word->value != 0) {
            if (auto good = in_range(kLimits.spindle_speed, word->value, command, *word, output); !good)
                return good;
        }
        state.spindle_rpm = word->value;
        state.spindle_stands = word->value == 0;
    }
    if (const auto code = command.m(MGroup::spindle)) {
        state.spindle = code->tenths == 50                          ? Spindle::off
                        : code->tenths == 40 || code->tenths == 140 ? Spindle::counter_clockwise
                                                                    : Spindle::clockwise;
        // Printer controls take the speed in percent as P.
        const bool is_others = command.has_any("XYZ") || command.g(GGroup::non_modal) ||
                               command.g(GGroup::path_control) || command.m(MGroup::subprogram);
        const Word* share = is_others ? nullptr : command.use('P');
        if (share != nullptr && output.first(Note::spindle_number)) {
            output.warn(command.line(),
                        code_text('M', code->tenths) +
                            " with P: a share of the full speed, which only the machine knows; "
                            "the spindle is taken as turning");
        }
    }
    return {};
}

Result<void> set_tool(Command& command, State& state, Output& output) {
    const int before = state.tool();
    if (const Word* word = command.use('T')) {
        if (word->value != 0) {
            if (auto good = in_range(kLimits.tool_number, word->value, command, *word, output); !good)
                return good;
        }
        state.selected_tool = static_cast<int>(word->value);
        if (word->value != std::floor(word->value) && output.first(Note::tool_offset)) {
            output.warn(command.line(),
                        "the digits of T after the point are taken as the number of the tool's "
                        "offset (Fagor): tool " +
                            std::to_string(state.selected_tool));
        }
    }
    if (command.names_next_tool() && output.first(Note::second_tool)) {
        output.warn(command.line(),
                    "T stands twice beside M6: the second is taken as the tool after this one");
    }
    if (command.m(MGroup::tool)) {
        state.loaded_tool = state.selected_tool;
        state.has_changed_tool = true;
    }
    if (command.m(MGroup::tool) || state.tool() != before) output.notes.change(state.tool());
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

// Returns the place of the work system in State::work.
Result<int> work_index(Command& command, Code code, const Output& output) {
    if (code.tenths >= 1100 && code.tenths <= 1290) return kWorkSystems + (code.tenths - 1100) / 10;
    const bool is_numbered = code.tenths == 541 || code.tenths == 1540;
    const bool owns_p = code.tenths == 540 && command.has('P') && !command.g(GGroup::path_control) &&
                        !command.g(GGroup::non_modal) && !command.g(GGroup::motion) && !command.has_any_m();
    if (!is_numbered && !owns_p) {
        return code.tenths <= 590 ? (code.tenths - 540) / 10 : 5 + code.tenths - 590;
    }
    const Word* number = command.use('P');
    if (number == nullptr || !(number->value >= 1 && number->value <= kMoreWorkSystems) ||
        number->value != std::floor(number->value)) {
        return output.refuse(command.line(), number == nullptr ? code.column : number->column,
                             code_text('G', code.tenths) + " without a work system P from 1 to 300",
                             "write its number as P");
    }
    return kWorkSystems + static_cast<int>(number->value) - 1;
}

Result<void> set_work_system(Command& command, State& state, Output& output) {
    const auto code = command.g(GGroup::work_offset);
    if (!code) return {};
    const auto index = work_index(command, *code, output);
    if (!index) return std::unexpected(index.error());
    if (state.tilt && *index != state.active_work) {
        return output.refuse(command.line(), code->column,
                             code_text('G', code->tenths) + " chooses another work system in a tilted plane",
                             "end the plane by G69 before it");
    }
    const double before_deg = state.active().turn_deg;
    state.active_work = *index;
    state.reframe(before_deg);
    const bool unset = state.active_work != 0 && !state.work[static_cast<std::size_t>(state.active_work)].set;
    if (unset && output.first(Note::work_system)) {
        output.warn(command.line(),
                    code_text('G', code->tenths) +
                        ": the program does not say where this work system lies; its origin is taken as the "
                        "stock's");
    }
    return {};
}

// G5 P10000, G5.1 Q1: look-ahead and smoothing of Fanuc controls, which leave the path as it is.
bool is_look_ahead(const Command& command, Code code, const Output& output) {
    if (code.tenths != 50 && code.tenths != 51) return false;
    if (output.options.dialect == GcodeDialect::fanuc) return true;
    return command.has_any("PQ") && !command.has_any("XYZIJ");
}

void set_motion_mode(Command& command, State& state, const Output& output) {
    const auto code = command.g(GGroup::motion);
    if (command.g(GGroup::cycle_end)) state.motion = MotionMode::none;
    if (!code) return;
    if (is_look_ahead(command, *code, output)) {
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
            state.motion = MotionMode::none;
            break;
        default:
            begin_cycle(*code, state);
            break;
    }
    if (code->tenths <= 30) state.plain_motion = state.motion;
}

// Codes that move nothing, with their words.
void pass_idle_codes(Command& command, State& state, Output& output) {
    if (command.g(GGroup::path_control)) {
        for (const char letter : {'P', 'Q'}) command.use(letter);  // tolerances of rounded corners
    }
    if (const auto code = command.g(GGroup::scaling); code && command.has('S')) {
        command.use('S');
        if (output.first(Note::idle_code, code->tenths)) {
            output.warn(command.line(), "S of G50, the largest speed of a lathe, is left out");
        }
    }
    const auto code = command.g(GGroup::idle);
    if (!code) return;
    if (code->tenths == 740) {
        state.single_quadrant = true;
        return;
    }
    if (code->tenths == 544 && output.first(Note::idle_code, code->tenths)) {
        output.warn(command.line(), "G54.4: the part is taken to stand as the program says, without errors");
    }
    const bool engraves = code->tenths == 470;
    const bool has_places = engraves || code->tenths == 220 || code->tenths == 281 || code->tenths == 301;
    if (has_places) {
        for (const char letter : {'X', 'Y', 'Z', 'A', 'B', 'C', 'I', 'J', 'K'}) {
            command.use(letter);
            command.hide(letter);
        }
    }
    if (!command.g(GGroup::motion)) {
        for (const char letter : {'P', 'Q', 'R', 'E', 'I', 'J'}) command.use(letter);
    }
    if (engraves) {
        for (Known& known : state.known) {
            if (known == Known::yes) known = Known::lost;
        }
        state.lost_line = command.line();
        if (output.first(Note::idle_code, code->tenths)) {
            output.warn(
                command.line(),
                "G47 engraves letters of the control's own: they are left out, and the tool's place is "
                "unknown after them");
        }
        return;
    }
    if (has_places && output.first(Note::idle_code, code->tenths)) {
        output.warn(command.line(), code_text('G', code->tenths) + " sets up the machine and moves nothing");
    }
}

// M70 saves the modes, M71 forgets them, M72 restores them.
void save_or_restore(Code code, State& state) {
    if (code.tenths == 710) state.saved.reset();
    if (code.tenths == 700) {
        state.saved = SavedModes{
            state.unit_mm,   state.plane, state.incremental, state.absolute_centres, state.retract_to_r,
            state.feed_mode, state.feed,  state.spindle,     state.spindle_rpm,      state.active_work};
    }
    if (code.tenths != 720 || !state.saved) return;
    const SavedModes& saved = *state.saved;
    const double before_deg = state.active().turn_deg;
    state.unit_mm = saved.unit_mm;
    state.plane = saved.plane;
    state.incremental = saved.incremental;
    state.absolute_centres = saved.absolute_centres;
    state.retract_to_r = saved.retract_to_r;
    state.feed_mode = saved.feed_mode;
    state.feed = saved.feed;
    state.spindle = saved.spindle;
    state.spindle_rpm = saved.spindle_rpm;
    state.active_work = saved.active_work;
    state.reframe(before_deg);
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
    if (auto done = set_work_system(command, state, output); !done) return done;
    pass_idle_codes(command, state, output);
    if (auto done = set_program_frame(command, state, output); !done) return done;
    if (auto done = begin_compensation(command, state, output); !done) return done;
    if (auto done = switch_cylinder(command, state, output); !done) return done;
    if (command.m(MGroup::outputs) || command.m(MGroup::overrides) || command.m(MGroup::orientation)) {
        for (const char letter : {'P', 'Q', 'E'}) command.use(letter);
        if (command.m(MGroup::orientation) && !command.has_any("XYZ")) command.use('R');
    }
    if (const auto code = command.g(GGroup::distance)) state.incremental = code->tenths == 910;
    if (const auto code = command.g(GGroup::arc_distance)) {
        state.absolute_centres = code->tenths == 901;
        state.centres_stated = true;
    }
    if (const auto code = command.g(GGroup::return_level)) {
        state.retract_to_r = code->tenths == 990;
        state.return_level_stated = true;
    }
    set_motion_mode(command, state, output);
    if (const auto code = command.m(MGroup::saved_modes)) {
        if (state.compensation.is_on && state.compensation.left_mm != 0 && code->tenths == 720) {
            return output.refuse(command.line(), code->column, "M72 while cutter compensation is on",
                                 "write G40 before it");
        }
        save_or_restore(*code, state);
    }
    if (auto done = switch_tip_control(command, state, output); !done) return done;
    switch_turning_zero(command, state, output);
    return {};
}

}  // namespace tribo::readers::gcode
