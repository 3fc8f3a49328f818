// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/offsets.hpp"

#include <array>
#include <cmath>

#include "readers/gcode/motion/motion.hpp"
#include "readers/gcode/motion/moves.hpp"
#include "readers/gcode/motion/parallel_axes.hpp"

namespace tribo::readers::gcode {
namespace {

// G4: P as of any dwell; X, U and S (Marlin) in seconds. On Fanuc controls X and U count least increments, of
// 0.001 s, unless they are written with a decimal point or computed (B-63944, dwell).
Result<void> apply_dwell(Command& command, State& state, Output& output) {
    const Word* length = command.use('P');
    const bool is_p = length != nullptr;
    for (const char letter : {'X', 'U', 'S'}) {
        if (length == nullptr) length = command.use(letter);
    }
    if (length == nullptr) {
        if (output.first(Note::empty_code, 40)) {
            output.warn(command.line(), "a dwell (G4) without a time: it is left out");
        }
        return {};
    }
    const bool is_axis = length->letter == 'X' || length->letter == 'U';
    const bool in_increments = is_axis && !length->is_computed;
    const double seconds = is_p || in_increments ? dwell_s(*length, output) : length->value;
    if (in_increments && seconds != length->value && output.first(Note::dwell_increments)) {
        output.warn(command.line(), std::string("G4 ") + length->letter +
                                        " without a decimal point counts milliseconds on a Fanuc control: "
                                        "write the point where seconds are meant");
    }
    if (auto good = in_range(kLimits.dwell, seconds, command, *length, output); !good) return good;
    return dwell(seconds, command, state, output);
}

// Returns the work system of the P word of G10; P0 is the one in force.
Result<std::size_t> work_system_of(Command& command, const State& state, const Output& output, int column) {
    const Word* system = command.use('P');
    if (system == nullptr || system->value < 0 || system->value > kWorkSystems ||
        system->value != std::floor(system->value)) {
        return output.refuse(command.line(), system == nullptr ? column : system->column,
                             "G10 without a work system P from 0 to 9",
                             "write P1 for G54, P2 for G55 and so on, P0 for the one in force");
    }
    const int index = system->value == 0 ? state.active_work : static_cast<int>(system->value) - 1;
    return static_cast<std::size_t>(index);
}

// The same for the systems of G54.1 (G10 L20 on a Fanuc control).
Result<std::size_t> more_work_system_of(Command& command, const Output& output, int column) {
    const Word* system = command.use('P');
    if (system == nullptr || !(system->value >= 1 && system->value <= kMoreWorkSystems) ||
        system->value != std::floor(system->value)) {
        return output.refuse(command.line(), system == nullptr ? column : system->column,
                             "G10 L20 without a work system P from 1 to 300", "write P1 for G54.1 P1");
    }
    return static_cast<std::size_t>(kWorkSystems + static_cast<int>(system->value) - 1);
}

// Changes a work system; the tip stays where it is in the stock.
void set_work(std::size_t index, const WorkSystem& work, State& state) {
    const double before_deg = state.active().turn_deg;
    state.work[index] = work;
    state.work[index].set = true;
    state.reframe(before_deg);
}

// G10 L2: sets origin and rotation of a work system.
Result<void> set_work_origin(Command& command, State& state, Output& output,
                             const Result<std::size_t>& index) {
    if (!index) return std::unexpected(index.error());
    WorkSystem work = state.work[*index];
    // Fanuc controls add to it in G91.
    const bool adds = state.incremental && output.options.dialect == GcodeDialect::fanuc;
    for (int axis = 0; axis < 3; ++axis) {
        const auto word = coordinate_mm(command, axis, state, output);
        if (!word) return std::unexpected(word.error());
        if (*word) work.origin_mm[axis] = **word + (adds ? work.origin_mm[axis] : 0);
    }
    if (const Word* turn = command.use('R')) {
        if (std::abs(turn->value) > 360) {
            return output.refuse(command.line(), turn->column,
                                 "a work system is turned by more than 360 degrees", "correct R");
        }
        work.turn_deg = turn->value;
        const bool knows_plane = state.known[0] == state.known[1];
        if (!knows_plane) {
            return output.refuse(command.line(), turn->column,
                                 "a work system is turned while only one of X and Y is known",
                                 "move both axes to a stated place before it");
        }
    }
    set_work(*index, work, state);
    return {};
}

// A block names the place of the tip where only the machine knows it: the zero of the program stays.
void place_by_name(const Command& command, int axis, double named_mm, const char* code, State& state,
                   Output& output) {
    Known& known = state.known[static_cast<std::size_t>(axis)];
    if (known == Known::lost && output.first(Note::lost_preset)) {
        output.warn(command.line(), std::string(code) +
                                        " at a place that only the machine knows since line " +
                                        std::to_string(state.lost_line) +
                                        ": the zero of the program is taken to stay where it was");
    }
    if (known == Known::unstated && output.first(Note::preset_as_origin)) {
        output.warn(command.line(),
                    std::string(code) +
                        " before the tool has a place: the coordinates count from the stock's "
                        "origin");
    }
    state.tip_mm[axis] = named_mm + state.origin_mm()[axis];
    known = Known::yes;
}

// G10 L20: sets the origin of a work system so that the tip has these coordinates in it.
Result<void> set_work_origin_by_tip(Command& command, State& state, Output& output, int column) {
    const auto index = work_system_of(command, state, output, column);
    if (!index) return std::unexpected(index.error());
    WorkSystem work = state.work[*index];
    if (const Word* turn = command.use('R')) {
        return output.refuse(command.line(), turn->column, "G10 L20 does not turn work systems",
                             "use G10 L2 R");
    }
    const Vec3 tip = turned(turned(state.tip_mm, state.active().turn_deg), -work.turn_deg);
    Vec3 origin = turned(work.origin_mm, -work.turn_deg);
    for (int axis = 0; axis < 3; ++axis) {
        const auto word = coordinate_mm(command, axis, state, output);
        if (!word) return std::unexpected(word.error());
        if (!*word) continue;
        if (state.known[static_cast<std::size_t>(axis)] != Known::yes) {
            if (static_cast<int>(*index) != state.active_work || work.turn_deg != 0) {
                return output.refuse(
                    command.line(), column,
                    std::string("G10 L20 names the tip's place while ") + "XYZ"[axis] + " is not known",
                    "move there by G0 before it, or use G10 L2");
            }
            place_by_name(command, axis, **word, "G10 L20", state, output);
            continue;
        }
        origin[axis] = tip[axis] - **word - (state.preset_on ? state.preset_mm[axis] : 0);
    }
    work.origin_mm = turned(origin, work.turn_deg);
    set_work(*index, work, state);
    return {};
}

// G10 L1: sets a line of the tool table. Only the radius is used here.
Result<void> set_tool_entry(Command& command, const State& state, Output& output, int column) {
    const Word* number = command.use('P');
    if (number == nullptr || !kLimits.tool_number.range.contains(number->value) ||
        number->value != std::floor(number->value)) {
        return output.refuse(command.line(), number == nullptr ? column : number->column,
                             "G10 L1 without the number of a tool", "write it as P");
    }
    for (const char letter : {'X', 'Y', 'Z', 'I', 'J', 'Q'}) command.use(letter);
    const Word* radius = command.use('R');
    if (radius == nullptr) return {};
    const double diameter_mm = 2 * radius->value * state.unit_mm;
    if (auto good = in_range(kLimits.offset_diameter, diameter_mm, command, *radius, output); !good)
        return good;
    output.declare_tool({static_cast<int>(number->value), diameter_mm});
    return {};
}

// Runs G10 by its L word.
Result<void> set_table(Command& command, State& state, Output& output, int column) {
    const Word* kind = command.use('L');
    if (kind != nullptr && kind->value == 1) return set_tool_entry(command, state, output, column);
    if (kind != nullptr && kind->value == 2) {
        return set_work_origin(command, state, output, work_system_of(command, state, output, column));
    }
    if (kind != nullptr && kind->value == 20) {
        if (output.options.dialect == GcodeDialect::fanuc) {
            return set_work_origin(command, state, output, more_work_system_of(command, output, column));
        }
        return set_work_origin_by_tip(command, state, output, column);
    }
    // Without L on the oldest Fanuc controls: G10 P R.
    const bool is_old = kind == nullptr && output.options.dialect == GcodeDialect::fanuc &&
                        command.has('P') && command.has('R') && !command.has_any("XYZ");
    if (is_old || (kind != nullptr && kind->value >= 10 && kind->value <= 13)) {
        for (const char letter : {'P', 'R', 'X', 'Y', 'Z', 'I', 'J', 'Q'}) command.use(letter);
        if (output.first(Note::tool_register)) {
            output.warn(
                command.line(),
                "G10 writes an offset of a tool: lengths are taken as measured right, diameters are those of "
                "the tools");
        }
        return {};
    }
    if (kind != nullptr && kind->value >= 90 && kind->value <= 99 &&
        output.options.dialect == GcodeDialect::fanuc) {
        for (const char letter : {'P', 'R', 'X', 'Y', 'Z', 'I', 'J', 'K', 'Q'}) command.use(letter);
        if (output.first(Note::drawing_data))
            output.warn(command.line(), "G10 L90 and on tell the control what to draw: left out");
        return {};
    }
    if (kind != nullptr && (kind->value == 50 || kind->value == 52) &&
        output.options.dialect == GcodeDialect::fanuc) {
        state.enters_data = true;
        if (output.first(Note::entered_data))
            output.warn(command.line(),
                        "G10 L50 and L52 to G11 set values of the control: they are left out");
        return {};
    }
    return output.refuse(command.line(), kind == nullptr ? column : kind->column,
                         "of G10 only L1, L10 to L13 (tools), L2 and L20 (work systems) are read",
                         "let the CAM system write the path without other settings");
}

// G52: shifts the zero of the program, in the same registers as G92 (LinuxCNC).
Result<void> shift_locally(Command& command, State& state, Output& output, int column) {
    if (!command.has_any("XYZ")) {
        return output.refuse(command.line(), column, "G52 without coordinates", "write X, Y or Z after it");
    }
    if (!state.preset_on) state.preset_mm = {};
    state.preset_on = true;
    for (int axis = 0; axis < 3; ++axis) {
        const auto word = coordinate_mm(command, axis, state, output);
        if (!word) return std::unexpected(word.error());
        if (*word) state.preset_mm[axis] = **word;
    }
    return {};
}

// G92: gives new coordinates to the current position of the tip.
Result<void> preset(Command& command, State& state, Output& output, int column) {
    if (auto done = preset_parallel_axes(command, state, output); !done) return done;
    if (!command.has_any("XYZ")) {
        if (command.has_any("ABCEUVW")) return {};
        return output.refuse(command.line(), column, "G92 without coordinates", "write X, Y or Z after it");
    }
    place_stock(command, state, output);
    if (!state.preset_on) state.preset_mm = {};
    state.preset_on = true;
    for (int axis = 0; axis < 3; ++axis) {
        const auto word = coordinate_mm(command, axis, state, output);
        if (!word) return std::unexpected(word.error());
        if (!*word) continue;
        if (state.known[static_cast<std::size_t>(axis)] != Known::yes) {
            place_by_name(command, axis, **word, "G92", state, output);
        } else {
            state.preset_mm[axis] += state.tip_mm[axis] - state.origin_mm()[axis] - **word;
        }
    }
    return {};
}

// G28, G30: a rapid to the point of the block, then to a position defined by the machine.
Result<void> go_home(Command& command, State& state, Output& output, int tenths) {
    // U V W are axes beside X Y Z, or their increments (lathe): alone they name no point on the way.
    std::array<bool, 3> goes{command.has_any("XU"), command.has_any("YV"), command.has_any("ZW")};
    const bool is_oblique = state.tilt && state.tilt->frame.is_tilted();
    if (!command.has_any("XYZABCUVW") || is_oblique) goes = {true, true, true};
    // An increment from an unknown position gives an unknown position.
    for (std::size_t axis = 0; axis < 3 && state.incremental; ++axis) {
        if (state.known[axis] == Known::unstated) state.known[axis] = Known::lost;
    }
    state.lost_line = command.line();
    for (const char letter : {'U', 'V', 'W'}) command.use(letter);
    home_parallel_axes(command, state);
    if (auto moved = move_rapidly(command, state, output); !moved) return moved;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (goes[axis]) state.known[axis] = Known::lost;
    }
    if (output.first(Note::machine_position)) {
        output.warn(
            command.line(),
            code_text('G', tenths) +
                " goes to a place that only the machine knows: the path is left out until X, Y and Z are "
                "known again");
    }
    return {};
}

// A move until a probe touches: where it ends, only the machine knows.
void probe(Command& command, State& state, Output& output) {
    for (int axis = 0; axis < 3; ++axis) {
        if (command.use("XYZ"[axis]) == nullptr) continue;
        state.known[static_cast<std::size_t>(axis)] = Known::lost;
        state.lost_line = command.line();
    }
    if (output.first(Note::probing)) {
        output.warn(command.line(),
                    code_text('G', command.g(GGroup::probing)->tenths) +
                        " (probing) ends where only the machine knows: the path is left out until "
                        "the axis has a place again");
    }
}

}  // namespace

Result<bool> apply_non_modal(Command& command, State& state, Output& output) {
    if (command.g(GGroup::probing)) {
        probe(command, state, output);
        return true;
    }
    const auto code = command.g(GGroup::non_modal);
    if (!code) return false;
    switch (code->tenths) {
        case 530:
            return false;
        case 921:
            state.preset_mm = {};
            [[fallthrough]];
        case 923:
            state.preset_on = true;
            return false;
        case 922:
            state.preset_on = false;
            return false;
        default:
            break;
    }
    const auto motion = command.g(GGroup::motion);
    // G0 and G1 beside it hold from the next block on.
    if (motion && command.has_any("XYZ") && motion->tenths > 10) {
        return output.refuse(command.line(), code->column,
                             code_text('G', code->tenths) + " and " + code_text('G', motion->tenths) +
                                 " both claim the coordinates of this block",
                             "put them on two lines");
    }
    Result<void> done;
    switch (code->tenths) {
        case 40:
            done = apply_dwell(command, state, output);
            break;
        case 100:
            done = set_table(command, state, output, code->column);
            break;
        case 520:
            done = shift_locally(command, state, output, code->column);
            break;
        case 920:
            done = preset(command, state, output, code->column);
            break;
        default:
            done = go_home(command, state, output, code->tenths);
            break;
    }
    if (!done) return std::unexpected(done.error());
    return true;
}

}  // namespace tribo::readers::gcode
