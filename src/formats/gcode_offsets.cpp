// SPDX-License-Identifier: MIT
#include "formats/gcode_offsets.hpp"

#include <array>
#include <cmath>

#include "formats/gcode_motion.hpp"
#include "formats/gcode_moves.hpp"

namespace tribo::formats::gcode {
namespace {

constexpr double kLongestDwellS = 86'400;

// G4: P in seconds; on a Fanuc control P in milliseconds or X in seconds.
Result<void> apply_dwell(Command& command, State& state, Output& output, int column) {
    const bool is_fanuc = output.options.dialect == GcodeDialect::fanuc;
    const Word* length = command.use('P');
    const bool in_milliseconds = is_fanuc && length != nullptr;
    if (length == nullptr && is_fanuc) length = command.use('X');
    const char* const remedy =
        is_fanuc ? "write its milliseconds as P or its seconds as X" : "write its seconds as P";
    if (length == nullptr) return output.refuse(command.line(), column, "a dwell (G4) without P", remedy);
    const double seconds = in_milliseconds ? length->value / 1000 : length->value;
    if (!(seconds >= 0) || seconds > kLongestDwellS) {
        return output.refuse(command.line(), length->column,
                             seconds < 0 ? "a dwell of negative length" : "a dwell of more than a day",
                             remedy);
    }
    return dwell(seconds, command, state, output);
}

// G10 L2: where a work system lies.
Result<void> set_work_origin(Command& command, State& state, Output& output, int column) {
    const Word* kind = command.use('L');
    if (kind == nullptr || kind->value != 2) {
        return output.refuse(command.line(), kind == nullptr ? column : kind->column,
                             "only G10 L2 (origin of a work system) is read yet",
                             "let the CAM system write the path without tool tables or settings");
    }
    const Word* system = command.use('P');
    if (system == nullptr || system->value < 0 || system->value > kWorkSystems ||
        system->value != std::floor(system->value)) {
        return output.refuse(command.line(), system == nullptr ? column : system->column,
                             "G10 L2 without a work system P from 0 to 9",
                             "write P1 for G54, P2 for G55 and so on, P0 for the one in force");
    }
    if (const Word* turn = command.use('R'); turn != nullptr && turn->value != 0) {
        return output.refuse(command.line(), turn->column, "turned work systems (G10 L2 R) are not read yet",
                             "let the CAM system write the path in an unturned system");
    }
    const int index = system->value == 0 ? state.active_work : static_cast<int>(system->value) - 1;
    WorkSystem& work = state.work[static_cast<std::size_t>(index)];
    for (int axis = 0; axis < 3; ++axis) {
        const auto word = coordinate_mm(command, axis, state, output);
        if (!word) return std::unexpected(word.error());
        if (*word) work.origin_mm[axis] = **word;
    }
    work.set = true;
    return {};
}

// G92: the tip's place gets new coordinates.
Result<void> preset(Command& command, State& state, Output& output, int column) {
    if (!command.has_any("XYZ")) {
        return output.refuse(command.line(), column, "G92 without coordinates", "write X, Y or Z after it");
    }
    if (!state.preset_on) state.preset_mm = {};
    state.preset_on = true;
    for (int axis = 0; axis < 3; ++axis) {
        const auto word = coordinate_mm(command, axis, state, output);
        if (!word) return std::unexpected(word.error());
        if (!*word) continue;
        Known& known = state.known[static_cast<std::size_t>(axis)];
        if (known == Known::lost) {
            return output.refuse(
                command.line(), column,
                "G92 names a place that only the machine knows since line " + std::to_string(state.lost_line),
                "write a rapid (G0) to a known place before it");
        }
        if (known == Known::unstated) {
            if (output.first(Note::preset_as_origin)) {
                output.warn(command.line(),
                            "G92 before the tool has a place: the coordinates count from the stock's origin");
            }
            state.tip_mm[axis] = **word + state.origin_mm()[axis];
            known = Known::yes;
        } else {
            state.preset_mm[axis] += state.tip_mm[axis] - state.origin_mm()[axis] - **word;
        }
    }
    return {};
}

// G28, G30: a rapid to the point that the block names, then to a place that only the machine knows.
Result<void> go_home(Command& command, State& state, Output& output, int tenths) {
    std::array<bool, 3> goes{command.has('X'), command.has('Y'), command.has('Z')};
    if (!command.has_any("XYZ")) goes = {true, true, true};
    // From a place that nothing has stated, an increment leads nowhere.
    for (std::size_t axis = 0; axis < 3 && state.incremental; ++axis) {
        if (state.known[axis] == Known::unstated) state.known[axis] = Known::lost;
    }
    state.lost_line = command.line();
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

}  // namespace

Result<bool> apply_non_modal(Command& command, State& state, Output& output) {
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
    const bool goes_home = code->tenths == 280 || code->tenths == 300;
    if (motion && command.has_any("XYZ") && !(goes_home && motion->tenths == 0)) {
        return output.refuse(command.line(), code->column,
                             code_text('G', code->tenths) + " and " + code_text('G', motion->tenths) +
                                 " both claim the coordinates of this block",
                             "put them on two lines");
    }
    Result<void> done;
    switch (code->tenths) {
        case 40:
            done = apply_dwell(command, state, output, code->column);
            break;
        case 100:
            done = set_work_origin(command, state, output, code->column);
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

}  // namespace tribo::formats::gcode
