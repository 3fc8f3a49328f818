// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/moves.hpp"

#include <algorithm>
#include <cmath>

#include "base/text/limit_text.hpp"
#include "readers/gcode/frames/tilted_plane.hpp"
#include "readers/gcode/motion/arc.hpp"
#include "readers/gcode/motion/compensation.hpp"
#include "readers/gcode/motion/corners.hpp"
#include "readers/gcode/motion/general_pocket.hpp"
#include "readers/gcode/motion/parallel_axes.hpp"
#include "readers/gcode/motion/rotary.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr char kPathLetters[] = "XYZ";

}  // namespace

// Returns the column of the first of these words in the block; 1 if it has none.
int column_of_any(Command& command, std::string_view letters) {
    for (const char letter : letters) {
        if (command.has(letter)) return command.use(letter)->column;
    }
    return 1;
}

Result<void> in_range(const Limit& limit, double value, const Command& command, const Word& word,
                      const Output& output) {
    if (limit.range.contains(value)) return {};
    return output.refuse(command.line(), word.column,
                         std::string(1, word.letter) + ": " + out_of_range(limit, value),
                         range_remedy(limit));
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

Result<void> append(const motion::Move& move, State& state, Output& output) {
    const Vec3 way = move.arc ? cross(move.arc->normal, move.end.tip_mm - move.arc->centre_mm)
                              : move.end.tip_mm - move.start.tip_mm;
    if (length(way) > 0) state.heading = normalized(way);
    if (state.corner) return join_at_corner(move, state, output);
    if (state.pocket) return keep_in_pocket(move, state, output);
    if (state.compensation.is_on) return compensate(move, state, output);
    return state.left_at_mm ? leave_compensation(move, state, output) : hand_out(move, state, output);
}

Result<void> hand_out(const motion::Move& move, State& state, Output& output) {
    if (output.machine) return append_on_machine(move, state, output);
    const bool leans = state.rotary.vectors || state.rotary.now_axis != Vec3{0, 0, 1};
    const motion::Move placed = in_stock(leans ? with_vectors(move, state) : move, state);
    if (state.tilt) {
        for (int axis = 0; axis < 3; ++axis) {
            if (kLimits.coordinate.range.contains(placed.end.tip_mm[axis])) continue;
            return output.refuse(
                move.line, 1,
                "in the tilted plane, " + out_of_range(kLimits.coordinate, placed.end.tip_mm[axis]),
                range_remedy(kLimits.coordinate));
        }
    }
    return output.append(placed);
}

Result<void> append_straight(motion::MoveKind kind, Vec3 to_mm, Command& command, State& state,
                             Output& output) {
    motion::Move move = new_move(kind, command, state);
    move.end.tip_mm = to_mm;
    if (move.start.tip_mm == to_mm && !state.left_at_mm) return {};
    if (kind == motion::MoveKind::feed) {
        if (auto fed = set_feed(move, command, state, output); !fed) return fed;
        note_spindle(command, state, output);
    }
    state.tip_mm = to_mm;
    return append(move, state, output);
}

void place_stock(const Command& command, State& state, Output& output) {
    const bool goes_home = command.has_g(GGroup::non_modal, 280) || command.has_g(GGroup::non_modal, 300);
    if (state.stock_at_mm || goes_home || !command.has_any("XYZ")) return;
    state.stock_at_mm = Vec3{};
    const WorkSystem& begins_in = state.active();
    if (output.options.dialect != GcodeDialect::fanuc || !begins_in.set) return;
    state.stock_at_mm = begins_in.origin_mm;
    if (begins_in.origin_mm != Vec3{} && output.first(Note::stock_place)) {
        output.warn(command.line(),
                    "the program states its work system from the zero of the machine: the stock's origin is "
                    "taken at the zero of that work system");
    }
}

namespace {

// Says where the zero of the program lies, if work offsets have put it beside the stock's origin.
void say_zero(const Command& command, const State& state, Output& output) {
    if (!state.active().set || !command.has_any("XYZ")) return;
    const Vec3 zero = state.zero_mm(state.active());
    if (zero == Vec3{} || !output.first(Note::moved_origin)) return;
    std::string place;
    for (int axis = 0; axis < 3; ++axis)
        place += " " + std::string(1, "XYZ"[axis]) + short_decimal(zero[axis]);
    output.warn(command.line(), "work offsets in the program put its zero at" + place +
                                    " mm from the stock's origin: set up the stock for that");
}

// The same in coordinates that are written turned, scaled, mirrored or polar.
Result<Target> target_in_frame(Command& command, State& state, Output& output) {
    const ProgramFrame& frame = state.frame;
    Vec3 written = frame.written(state.tip_mm - state.origin_mm());
    std::array<bool, 3> known{};
    for (std::size_t axis = 0; axis < 3; ++axis) known[axis] = state.known[axis] != Known::lost;
    if (auto done = write_target(command, state, output, written, known); !done) {
        return std::unexpected(done.error());
    }
    Target target{state.origin_mm() + frame.placed(written), state.known};
    const auto turns = axes_of(frame.turn_plane);
    for (int axis = 0; axis < 3; ++axis) {
        const bool in_turn = frame.turn_deg != 0 && axis != turns[2];
        const bool is_known =
            in_turn ? known[static_cast<std::size_t>(turns[0])] && known[static_cast<std::size_t>(turns[1])]
                    : known[static_cast<std::size_t>(axis)];
        const bool is_stated = command.has("XYZ"[axis]) || (in_turn && command.has_any("XYZ"));
        Known& place = target.known[static_cast<std::size_t>(axis)];
        if (!is_known) {
            place = Known::lost;
        } else if (is_stated || frame.is_polar) {
            place = Known::yes;
        }
        if (!kLimits.coordinate.range.contains(target.tip_mm[axis])) {
            return output.refuse(command.line(), column_of_any(command, "XYZ"),
                                 "turned or scaled, " + out_of_range(kLimits.coordinate, target.tip_mm[axis]),
                                 range_remedy(kLimits.coordinate));
        }
    }
    return target;
}

}  // namespace

// Returns the target of the axis words. In G91 an axis without a stated position starts at the zero of the
// program.
Result<Target> target_of(Command& command, State& state, Output& output) {
    place_stock(command, state, output);
    say_zero(command, state, output);
    const auto way = move_parallel_axes(command, state, output);
    if (!way) return std::unexpected(way.error());
    if (!state.frame.is_plain()) return target_in_frame(command, state, output);
    Target target{state.tip_mm + *way, state.known};
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
                output.warn(command.line(), std::string("incremental move before ") + kPathLetters[axis] +
                                                " is stated: it is taken to start at the program's zero");
            }
            place = state.tip_mm[axis] = state.origin_mm()[axis];
            known = state.known[static_cast<std::size_t>(axis)] = Known::yes;
            place += **word;
        }
        if (auto good =
                in_range(kLimits.coordinate, place, command, *command.use(kPathLetters[axis]), output);
            !good) {
            return std::unexpected(good.error());
        }
    }
    return target;
}

// Refuses a feed move without a known start.
Result<void> require_start(Command& command, State& state, Output& output) {
    std::string assumed;
    for (int axis = 0; axis < 3; ++axis) {
        Known& known = state.known[static_cast<std::size_t>(axis)];
        if (known == Known::lost) {
            return output.refuse(command.line(), column_of_any(command, "XYZIJKR"),
                                 std::string("the feed move starts at an unknown ") + kPathLetters[axis] +
                                     ", which line " + std::to_string(state.lost_line) +
                                     " moved to a place that only the machine knows",
                                 std::string("add a rapid (G0) with ") + kPathLetters[axis] + " before it");
        }
        if (known == Known::yes) continue;
        if (!assumed.empty()) assumed += ", ";
        assumed += kPathLetters[axis];
        assumed += '0';
        state.tip_mm[axis] = state.origin_mm()[axis];
        known = Known::yes;
    }
    if (!assumed.empty() && output.first(Note::unstated_axes)) {
        output.warn(command.line(),
                    "cut before all of X, Y and Z are stated: the tool is taken to start at " + assumed);
    }
    return {};
}

// Sets feed and time of a feed move with a complete path.
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
                        "no feed rate so far: " + short_decimal(move.feed_mm_per_min) +
                            " mm/min is taken; write F before it, or another feed_mm_per_min");
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
        if (!kLimits.feed.range.contains(move.feed_mm_per_min)) {
            return output.refuse(command.line(), column, out_of_range(kLimits.feed, move.feed_mm_per_min),
                                 range_remedy(kLimits.feed));
        }
    }
    return {};
}

void note_spindle(const Command& command, const State& state, Output& output) {
    if (state.spindle == Spindle::off) {
        if (output.first(Note::spindle_off)) {
            output.warn(command.line(), "feed move with the spindle off: it is taken as running (M3)");
        }
    } else if (state.spindle_stands) {
        if (output.first(Note::spindle_stands)) {
            output.warn(
                command.line(),
                "feed move with S0: the spindle stands still; it is taken as turning at the job's speed");
        }
    } else if (state.spindle == Spindle::counter_clockwise) {
        if (output.first(Note::spindle_backwards)) {
            output.warn(command.line(),
                        "feed move with the spindle turning backwards (M4): the cut is computed as with M3");
        }
    }
    if (!state.has_changed_tool && state.selected_tool != 0) {
        if (output.first(Note::tool_without_change)) {
            output.warn(command.line(), "T" + std::to_string(state.selected_tool) +
                                            " without M6: taken as the tool that is in the spindle");
        }
    }
}

Result<std::optional<double>> coordinate_mm(Command& command, int axis, State& state, Output& output) {
    if (axis == 1 && command.has('Y')) state.has_y = true;
    const auto coordinate = length_mm(command, kPathLetters[axis], state, output);
    if (coordinate && *coordinate) state.largest_mm = std::max(state.largest_mm, std::abs(**coordinate));
    return coordinate;
}

Result<std::optional<double>> length_mm(Command& command, char letter, State& state, Output& output) {
    const Word* word = command.use(letter);
    if (word == nullptr) return std::nullopt;
    const double value = word->value * state.unit_mm;
    if (auto good = in_range(kLimits.coordinate, value, command, *word, output); !good)
        return std::unexpected(good.error());
    if (!state.unit_stated) {
        if (output.first(Note::no_unit)) {
            const std::string taken = state.unit_is_of_texts
                                          ? "inches are taken, as the sizes of its tools are in inches"
                                          : std::string(plural(output.options.default_unit)) + " are taken";
            output.warn(command.line(), "no G20 or G21 before the first coordinates: " + taken);
        }
    }
    return value;
}

}  // namespace tribo::readers::gcode
