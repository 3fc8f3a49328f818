// SPDX-License-Identifier: MIT
#include "formats/gcode_motion.hpp"

#include <cmath>

#include "formats/decimal_text.hpp"
#include "formats/gcode_arc.hpp"

namespace tribo::formats::gcode {
namespace {

constexpr char kAxisLetters[] = "XYZ";
constexpr char kCentreLetters[] = "IJK";
constexpr double kMostExtraTurns = 10'000;

// Column of the first of these words in the block; 1 where it has none.
int column_of_any(Command& command, std::string_view letters) {
    for (const char letter : letters) {
        if (command.has(letter)) return command.use(letter)->column;
    }
    return 1;
}

std::unexpected<Error> refuse_far(Command& command, char letter, const Output& output) {
    return output.refuse(command.line(), command.use(letter)->column,
                         std::string(1, letter) + " lies more than a kilometre away", "correct it");
}

motion::Move new_move(motion::MoveKind kind, const Command& command, const State& state) {
    motion::Move move;
    move.kind = kind;
    move.start.tip_mm = move.end.tip_mm = state.tip_mm;
    move.spindle_rpm = state.spindle_rpm;
    move.tool = state.tool();
    move.line = command.line();
    return move;
}

Result<void> append(const motion::Move& move, const State& state, Output& output) {
    return output.append(move, state.active().turn_deg);
}

struct Target {
    Vec3 tip_mm;
    std::array<Known, 3> known;
};

// Where the axis words lead. In G91 an axis that nothing has stated is taken to start at the program's zero.
Result<Target> target_of(Command& command, State& state, Output& output) {
    Target target{state.tip_mm, state.known};
    for (int axis = 0; axis < 3; ++axis) {
        const auto word = coordinate_mm(command, axis, state, output);
        if (!word) return std::unexpected(word.error());
        if (!*word) continue;
        Known& known = target.known[static_cast<std::size_t>(axis)];
        double& place = target.tip_mm[axis];
        if (!state.incremental) {
            place = **word + state.origin_mm()[axis];
            known = Known::yes;
        } else if (known == Known::yes) {
            place += **word;
        } else if (known == Known::unstated) {
            if (output.first(Note::unstated_axes)) {
                output.warn(command.line(), std::string("incremental move before ") + kAxisLetters[axis] +
                                                " is stated: it is taken to start at the program's zero");
            }
            place = state.tip_mm[axis] = state.origin_mm()[axis];
            known = state.known[static_cast<std::size_t>(axis)] = Known::yes;
            place += **word;
        }
        if (std::abs(place) > kLargestCoordinateMm) {
            return refuse_far(command, kAxisLetters[axis], output);
        }
    }
    return target;
}

// A feed move needs to know where it starts.
Result<void> require_start(Command& command, State& state, Output& output) {
    std::string assumed;
    for (int axis = 0; axis < 3; ++axis) {
        Known& known = state.known[static_cast<std::size_t>(axis)];
        if (known == Known::lost) {
            return output.refuse(command.line(), column_of_any(command, "XYZIJKR"),
                                 std::string("the feed move starts at an unknown ") + kAxisLetters[axis] +
                                     ", which line " + std::to_string(state.lost_line) +
                                     " moved to a place that only the machine knows",
                                 std::string("add a rapid (G0) with ") + kAxisLetters[axis] + " before it");
        }
        if (known == Known::yes) continue;
        if (!assumed.empty()) assumed += ", ";
        assumed += kAxisLetters[axis];
        assumed += '0';
        state.tip_mm[axis] = state.origin_mm()[axis];
        known = Known::yes;
    }
    if (!assumed.empty() && output.first(Note::unstated_axes)) {
        output.warn(command.line(),
                    "feed move before all of X, Y and Z are stated: it is taken to start at " + assumed);
    }
    return {};
}

// Sets feed and time of a feed move whose path is complete.
Result<void> set_feed(motion::Move& move, Command& command, const State& state, Output& output) {
    const int column = column_of_any(command, "FXYZIJKR");
    if (state.feed_mode == FeedMode::inverse_time) {
        if (!state.feed || state.feed_line != command.line() || *state.feed == 0) {
            return output.refuse(command.line(), column, "a feed move in G93 without its own F above 0",
                                 "write F, one over the minutes that the move takes, or G94 before it");
        }
        move.feed_mm_per_min = motion::path_length_mm(move) * *state.feed;
        move.duration_s = 60 / *state.feed;
        return {};
    }
    if (!state.feed && state.feed_mode == FeedMode::per_minute &&
        output.options.default_feed_mm_per_min > 0) {
        move.feed_mm_per_min = output.options.default_feed_mm_per_min;
        if (output.first(Note::default_feed)) {
            output.warn(command.line(),
                        "no feed rate so far: " + short_decimal(move.feed_mm_per_min) + " mm/min is taken");
        }
        return {};
    }
    if (!state.feed) {
        return output.refuse(command.line(), column, "a feed move before any F word",
                             "add an F word to this line or before it");
    }
    if (*state.feed == 0) {
        return output.refuse(command.line(), column, "a feed move with feed rate 0", "write an F above 0");
    }
    move.feed_mm_per_min = *state.feed;
    if (state.feed_mode == FeedMode::per_turn) {
        if (state.spindle_rpm == 0) {
            return output.refuse(command.line(), column,
                                 "a feed per turn (G95) with the spindle speed unknown",
                                 "write S before it, or G94 with a feed per minute");
        }
        move.feed_mm_per_min *= state.spindle_rpm;
    }
    return {};
}

void note_spindle(const Command& command, const State& state, Output& output) {
    if (state.spindle == Spindle::off) {
        if (output.first(Note::spindle_off)) {
            output.warn(command.line(), "feed move with the spindle off: it is taken as running (M3)");
        }
    } else if (state.spindle == Spindle::counter_clockwise) {
        if (output.first(Note::spindle_backwards)) {
            output.warn(command.line(),
                        "feed move with the spindle turning backwards (M4): taken as a cut all the same");
        }
    }
    if (!state.has_changed_tool && state.selected_tool != 0) {
        if (output.first(Note::tool_without_change)) {
            output.warn(command.line(), "T" + std::to_string(state.selected_tool) +
                                            " without M6: taken as the tool that is in the spindle");
        }
    }
}

Result<int> extra_turns(Command& command, const Output& output) {
    const Word* turns = command.use('P');
    if (turns == nullptr) return 0;
    if (turns->value < 1 || turns->value > kMostExtraTurns || turns->value != std::floor(turns->value)) {
        return output.refuse(command.line(), turns->column,
                             "the number of turns P is not a whole number above 0", "correct P");
    }
    return static_cast<int>(turns->value) - 1;
}

// The arc from the tip to the target.
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
        if (std::abs(radius_mm) > kLargestCoordinateMm) return refuse_far(command, 'R', output);
        return placed(arc_of_radius(ends, radius_mm), radius->column);
    }
    Vec3 centre = state.absolute_centres ? state.origin_mm() : state.tip_mm;
    int column = 0, given = 0;
    for (int i = 0; i < 2; ++i) {
        const Word* word = command.use(kCentreLetters[axes[static_cast<std::size_t>(i)]]);
        if (word == nullptr) continue;
        const double offset_mm = word->value * state.unit_mm;
        if (std::abs(offset_mm) > kLargestCoordinateMm) return refuse_far(command, word->letter, output);
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
    note_spindle(command, state, output);
    const bool stays = !move.arc && move.start.tip_mm == move.end.tip_mm;
    state.tip_mm = target->tip_mm;
    return stays ? Result<void>{} : append(move, state, output);
}

// G53: coordinates that count from the machine's own zero, of which a program says nothing.
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

Result<std::optional<double>> coordinate_mm(Command& command, int axis, const State& state, Output& output) {
    const Word* word = command.use(kAxisLetters[axis]);
    if (word == nullptr) return std::nullopt;
    const double value = word->value * state.unit_mm;
    if (std::abs(value) > kLargestCoordinateMm) {
        return refuse_far(command, kAxisLetters[axis], output);
    }
    if (!state.unit_stated) {
        if (output.first(Note::no_unit)) {
            output.warn(command.line(), "no G20 or G21 before the first coordinates: " +
                                            std::string(plural(output.options.default_unit)) + " are taken");
        }
    }
    return value;
}

Result<void> move_rapidly(Command& command, State& state, Output& output) {
    const auto target = target_of(command, state, output);
    if (!target) return std::unexpected(target.error());
    motion::Move move = new_move(motion::MoveKind::rapid, command, state);
    const bool known = state.knows_tip();
    state.tip_mm = target->tip_mm;
    state.known = target->known;
    move.end.tip_mm = state.tip_mm;
    if (!known || !state.knows_tip() || move.start.tip_mm == move.end.tip_mm) return {};
    return append(move, state, output);
}

Result<void> apply_motion(Command& command, State& state, Output& output) {
    const bool turns =
        state.motion == MotionMode::arc_clockwise || state.motion == MotionMode::arc_counter_clockwise;
    const bool moves = command.has_any("XYZ") || (turns && command.has_any("IJKR"));
    if (command.has_g(GGroup::non_modal, 530)) {
        return move_to_machine_position(command, state, output, command.g(GGroup::non_modal)->column);
    }
    if (!moves) return {};
    if (state.motion == MotionMode::none) {
        return output.refuse(command.line(), column_of_any(command, "XYZ"),
                             "coordinates without a motion code in force",
                             "write G0, G1, G2 or G3 on this line or before it");
    }
    return state.motion == MotionMode::rapid ? move_rapidly(command, state, output)
                                             : move_at_feed(command, state, output);
}

Result<void> dwell(double seconds, const Command& command, const State& state, Output& output) {
    if (!state.knows_tip() || seconds == 0) return {};
    motion::Move move = new_move(motion::MoveKind::dwell, command, state);
    move.duration_s = seconds;
    return append(move, state, output);
}

}  // namespace tribo::formats::gcode
