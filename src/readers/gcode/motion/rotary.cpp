// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/rotary.hpp"

#include <cmath>

#include "base/math.hpp"
#include "motion/algebra/direction.hpp"
#include "readers/control/rotary_feed.hpp"
#include "readers/gcode/frames/tilted_plane.hpp"
#include "readers/gcode/motion/moves.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr char kRotaryLetters[] = "ABC";

void note_machine_needed(const Command& command, Output& output) {
    motion::Program& program = output.program;
    if (!program.has_rotary_words) program.first_rotary_line = command.line();
    program.has_rotary_words = true;
}

// Switch of tool tip control by the block, if any.
struct Switch {
    bool on = false;
    bool by_length_code = false;
    bool vectors = false;
};
std::optional<Switch> switch_in(const Command& command, const State& state) {
    if (const auto code = command.m(MGroup::tool_tip)) {
        return Switch{code->tenths == 1280 || code->tenths == 4280, false, false};
    }
    const auto code = command.g(GGroup::tool_length);
    if (!code) return std::nullopt;
    switch (code->tenths) {
        case 434:
        case 435:
        case 1690:
        case 2340:
            return Switch{true, true, code->tenths == 435};
        default:  // G43 and G49 end tool tip control by such a code
            if (!state.rotary.by_length_code) return std::nullopt;
            return Switch{};
    }
}

// Returns the word of axis 0 to 2 (A B C); absent if the block has none.
Result<std::optional<double>> word_rad(Command& command, int axis, const Output& output) {
    const Word* word = command.use(kRotaryLetters[axis]);
    if (word == nullptr) return std::nullopt;
    const std::string letter(1, kRotaryLetters[axis]);
    if (!output.machine->has_axis(kRotaryLetters[axis])) {
        return output.refuse(command.line(), word->column,
                             "the machine " + output.machine->machine().name + " has no axis " + letter,
                             "name the machine that the program is written for");
    }
    if (auto good = in_range(kLimits.rotary_angle, word->value, command, *word, output); !good)
        return std::unexpected(good.error());
    return word->value * math::kRadPerDeg;
}

Result<void> read_vector(Command& command, State& state, Output& output) {
    const Word* first = nullptr;
    Vec3 axis;
    for (int k = 0; k < 3; ++k) {
        const Word* word = command.use("IJK"[k]);
        if (word == nullptr) continue;
        if (first == nullptr) first = word;
        axis[k] = state.rotary.vectors_to_tip ? -word->value : word->value;
    }
    if (first == nullptr) return {};
    if (!(length(axis) > 1e-6)) {
        return output.refuse(command.line(), first->column, "the tool's axis I J K has no direction",
                             "write the direction from the tip to the shank");
    }
    // As X Y Z of its block, the vector is written in the coordinates in force.
    axis = state.frame.placed_direction(axis);
    const double turn_deg = state.active().turn_deg;
    if (state.tilt) axis = turned(state.tilt->frame.direction_in_stock(axis), -turn_deg);
    if (!output.machine) {
        state.rotary.target_axis = normalized(axis);
        state.rotary.stated = true;
        return {};
    }
    const auto reached = output.machine->kinematics().joints({{}, turned(normalized(axis), turn_deg)},
                                                             {{}, state.rotary.now_rad});
    if (!reached) {
        return output.refuse(command.line(), first->column,
                             "the machine " + output.machine->machine().name + " cannot turn its tool there",
                             "name the machine that the program is written for");
    }
    state.rotary.target_rad = reached->joints.rotary_rad;
    state.rotary.stated = true;
    return {};
}

// G28, G30: turns the rotary axes of the block to their home, or all if the block names no axis.
void turn_home(Command& command, State& state, Output& output) {
    const bool all = !command.has_any("XYZABC");
    for (int axis = 0; axis < 3; ++axis) {
        if (command.use(kRotaryLetters[axis]) == nullptr && !all) continue;
        if (state.rotary.now_rad[axis] != 0 && output.first(Note::rotary_home)) {
            output.warn(command.line(), code_text('G', command.g(GGroup::non_modal)->tenths) +
                                            ": the home of the rotary axes is taken to be their zero");
        }
        state.rotary.target_rad[axis] = 0;
    }
}

// G10 L2: sets the zeros of the rotary axes in a work system. L and P are checked with X Y Z.
Result<void> set_rotary_origin(Command& command, State& state, const Output& output) {
    const Word* system = command.use('P');
    const int index = system == nullptr || !(system->value >= 1 && system->value <= kWorkSystems)
                          ? state.active_work
                          : static_cast<int>(system->value) - 1;
    for (int axis = 0; axis < 3; ++axis) {
        const auto angle = word_rad(command, axis, output);
        if (!angle) return std::unexpected(angle.error());
        if (*angle) state.rotary.origin_rad[static_cast<std::size_t>(index)][axis] = **angle;
    }
    return {};
}

// G92: gives the rotary axes of the block new angles where they stand.
Result<void> preset_rotary(Command& command, State& state, const Output& output) {
    Vec3& origin = state.rotary.origin_rad[static_cast<std::size_t>(state.active_work)];
    for (int axis = 0; axis < 3; ++axis) {
        const auto angle = word_rad(command, axis, output);
        if (!angle) return std::unexpected(angle.error());
        if (*angle) origin[axis] = state.rotary.now_rad[axis] - **angle;
    }
    return {};
}

}  // namespace

Result<void> switch_tip_control(const Command& command, State& state, Output& output) {
    const auto to = switch_in(command, state);
    if (!to) return {};
    if (!output.machine && to->vectors) {
        state.rotary.vectors = state.rotary.by_length_code = true;
        return {};
    }
    if (!output.machine && state.rotary.vectors) {
        state.rotary.vectors = state.rotary.by_length_code = false;
        return {};
    }
    if (!output.machine) {
        note_machine_needed(command, output);
        if (output.first(Note::tool_tip_switch)) {
            const auto m = command.m(MGroup::tool_tip);
            const std::string text =
                m ? code_text('M', m->tenths) : code_text('G', command.g(GGroup::tool_length)->tenths);
            output.warn(command.line(), text +
                                            " switches tool tip control: the program needs a machine to "
                                            "be understood");
        }
        return {};
    }
    if (const auto code = command.m(MGroup::tool_tip); code && code->tenths == 4300) {
        return output.refuse(command.line(), code->column,
                             "M430 switches to kinematics that only its own machine knows",
                             "use M428 for tool tip control, M429 for none");
    }
    RotaryState& rotary = state.rotary;
    rotary.by_length_code = to->by_length_code;
    rotary.vectors = to->vectors;
    if (rotary.tip_control == to->on) return {};
    rotary.tip_control = to->on;
    if (state.tilt) return {};  // coordinates are those of the tip already
    const motion::Kinematics& kinematics = output.machine->kinematics();
    if (!to->on && output.machine->needs_tool_length(rotary.now_rad)) {
        // The positions of the joints depend on the tool length, which is not known: the tip is lost.
        state.known = {Known::lost, Known::lost, Known::lost};
        state.lost_line = command.line();
        return {};
    }
    if (!state.knows_tip()) {
        if (rotary.now_rad == Vec3{}) return {};
        state.known = {Known::lost, Known::lost, Known::lost};
        state.lost_line = command.line();
        return {};
    }
    const Vec3 zero = kinematics.stock_mm(), tip = turned(state.tip_mm, state.active().turn_deg);
    const Vec3 coordinates = to->on ? kinematics.pose({tip + zero, rotary.now_rad}).tip_mm
                                    : kinematics.with_tip(tip, rotary.now_rad).linear_mm - zero;
    state.tip_mm = turned(coordinates, -state.active().turn_deg);
    return {};
}

void switch_turning_zero(Command& command, State& state, Output& output) {
    const auto code = command.g(GGroup::turning_zero);
    if (!code) return;
    bool turns = code->tenths == 2540;
    if (code->tenths == 542) {
        const Word* number = command.use('P');
        turns = number != nullptr && number->value != 0;
    }
    if (!output.machine || output.machine->zero_turns() == turns) return;
    MachineRun& machine = *output.machine;
    const Vec3 at_rad = state.rotary.now_rad;
    const bool names_tip = state.rotary.tip_control || state.tilt || at_rad == Vec3{};
    if (!names_tip && !state.knows_tip()) {
        state.known = {Known::lost, Known::lost, Known::lost};
        state.lost_line = command.line();
    }
    const double turn_deg = state.active().turn_deg;
    const Vec3 written = turned(state.tip_mm, turn_deg) + machine.kinematics().stock_mm();
    const Vec3 tip_in_stock = machine.kinematics().pose({written, at_rad}).tip_mm;
    machine.let_zero_turn(turns);
    if (names_tip || !state.knows_tip()) return;
    const motion::Kinematics& kinematics = machine.kinematics();
    const Vec3 now = kinematics.with_tip(tip_in_stock, at_rad).linear_mm - kinematics.stock_mm();
    state.tip_mm = turned(now, -turn_deg);
}

Result<void> read_rotary_words(Command& command, State& state, Output& output) {
    RotaryState& rotary = state.rotary;
    rotary.stated = false;
    if (rotary.vectors && (state.motion == MotionMode::line || state.motion == MotionMode::rapid)) {
        if (auto done = read_vector(command, state, output); !done) return done;
    }
    if (!output.machine) {
        bool turns = false;
        for (const char letter : {'A', 'B', 'C'}) {
            const Word* word = command.use(letter);
            turns = turns || (word != nullptr && (word->value != 0 || output.program.has_rotary_words));
        }
        // At zero there is nothing to turn; posts for four axes write A0 into programs of three.
        if (!turns) return {};
        note_machine_needed(command, output);
        if (output.first(Note::rotary_words)) {
            output.warn(command.line(),
                        "rotary words (A B C) mean nothing without a machine: their motion is left out");
        }
        return {};
    }
    const auto code = command.g(GGroup::non_modal);
    if (code && (code->tenths == 280 || code->tenths == 300)) {
        turn_home(command, state, output);
        return {};
    }
    if (!command.has_any("ABC")) return {};
    note_machine_needed(command, output);
    if (code && code->tenths == 100) return set_rotary_origin(command, state, output);
    if (code && code->tenths == 920) return preset_rotary(command, state, output);
    for (int axis = 0; axis < 3; ++axis) {
        const auto angle = word_rad(command, axis, output);
        if (!angle) return std::unexpected(angle.error());
        if (!*angle) continue;
        const bool of_machine = command.has_g(GGroup::non_modal, 530);
        const double from = state.incremental ? rotary.now_rad[axis]
                            : of_machine
                                ? 0
                                : rotary.origin_rad[static_cast<std::size_t>(state.active_work)][axis];
        rotary.target_rad[axis] = from + **angle;
        rotary.stated = true;
    }
    return {};
}

motion::Move with_vectors(const motion::Move& move, State& state) {
    motion::Move leaning = move;
    leaning.start.axis = state.rotary.now_axis;
    leaning.end.axis = state.rotary.target_axis;
    state.rotary.now_axis = state.rotary.target_axis;
    return leaning;
}

void set_turning_time(motion::Move& move, const State& state, Output& output) {
    if (!state.rotary.turns() || move.kind != motion::MoveKind::feed || move.duration_s > 0) return;
    const double length = motion::path_length_mm(move);
    // With tool tip control the feed is that of the tip, unless the tip stands still.
    if ((state.rotary.tip_control || state.rotary.vectors || state.tilt) && length > 0) return;
    const RotaryState& rotary = state.rotary;
    const bool is_fanuc = output.options.dialect == GcodeDialect::fanuc;
    RotaryFeed rule{{}, state.unit_mm};
    if (is_fanuc) rule = RotaryFeed::degrees_as_lengths(state.unit_mm);
    const Vec3 turn = rotary.target_rad - rotary.now_rad;
    // A vector without a machine turns the tool by its angle.
    const Vec3 lean{motion::angle_rad(rotary.now_axis, rotary.target_axis), 0, 0};
    move.duration_s = turning_time_s(length, turn == Vec3{} ? lean : turn, move.feed_mm_per_min, rule);
    if (is_fanuc && output.first(Note::rotary_feed)) {
        output.warn(
            move.line,
            "the feed of a move that turns counts a degree as a unit of length, as Fanuc controls do; Haas "
            "controls count the diameters of their settings 34 and 79: write G93 for one time on both");
    }
}

Result<void> append_on_machine(const motion::Move& move, State& state, Output& output) {
    RotaryState& rotary = state.rotary;
    const bool is_tip = rotary.tip_control || state.tilt;  // coordinates are those of the tip
    if (!is_tip && (output.machine->needs_tool_length(rotary.now_rad) ||
                    output.machine->needs_tool_length(rotary.target_rad))) {
        return output.refuse(move.line, 1,
                             "where the tilted head of the machine " + output.machine->machine().name +
                                 " brings the tip depends on the tool's length",
                             "add tool_length_mm, from the spindle nose to the tip, to the machine");
    }
    const motion::Move program = in_stock(move, state);
    motion::MachineBlock block;
    block.tip_control = is_tip;
    block.start_mm = program.start.tip_mm;
    block.end_mm = program.end.tip_mm;
    block.arc = program.arc;
    block.quadratic = program.quadratic;
    block.start_rad = rotary.now_rad;
    block.end_rad = rotary.target_rad;
    rotary.now_rad = rotary.target_rad;
    const auto* pieces = output.machine->run(block, move, output.options.max_moves - output.moves + 1);
    if (pieces == nullptr)
        return output.refuse(move.line, 1, MachineRun::kTooManyPieces, MachineRun::kFewerPieces);
    for (const motion::Move& piece : *pieces) {
        if (auto done = output.append(piece); !done) return done;
    }
    return {};
}

}  // namespace tribo::readers::gcode
