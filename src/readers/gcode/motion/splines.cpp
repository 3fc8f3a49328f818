// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/splines.hpp"

#include <algorithm>
#include <cmath>

#include "motion/path/moves.hpp"
#include "readers/gcode/motion/moves.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::gcode {
namespace {

using motion::HomogeneousPoint;

constexpr std::size_t kHighestOrder = 10;
constexpr std::size_t kMostControlPoints = 100'000;
constexpr double kLargestKnot = 1e9;
// Largest distance of the first control point of a G6.2 from the tip, mm: the rounding of three decimals.
constexpr double kJoinMm = 0.002;

Result<std::optional<double>> length_word(Command& command, char letter, const State& state,
                                          const Output& output) {
    const Word* word = command.use(letter);
    if (word == nullptr) return std::nullopt;
    const double value = word->value * state.unit_mm;
    if (auto good = in_range(kLimits.coordinate, value, command, *word, output); !good)
        return std::unexpected(good.error());
    return value;
}

// Reads a pair of words that place a control point in the plane; none if the block has neither.
Result<std::optional<Vec3>> offset_words(Command& command, const char* letters, const State& state,
                                         const Output& output) {
    const auto x = length_word(command, letters[0], state, output);
    if (!x) return std::unexpected(x.error());
    const auto y = length_word(command, letters[1], state, output);
    if (!y) return std::unexpected(y.error());
    if (!*x && !*y) return std::nullopt;
    return Vec3{x->value_or(0), y->value_or(0), 0};
}

int motion_column(Command& command) {
    const auto code = command.g(GGroup::motion);
    return code ? code->column : column_of_any(command, "XYZIJKPQR");
}

// Template of the moves of the curve: feed and words. The length of the curve counts in inverse time.
Result<motion::Move> like_of(double length_mm, Command& command, const State& state, Output& output) {
    motion::Move like = new_move(motion::MoveKind::feed, command, state);
    like.end.tip_mm.x += length_mm;
    if (auto fed = set_feed(like, command, state, output); !fed) return std::unexpected(fed.error());
    note_spindle(command, state, output);
    return like;
}

// The curve of a tip with constant axis. A translation by t is 1 + e t / 2; its magnitude is the weight.
motion::DualQuaternion translation(const HomogeneousPoint& p) {
    return {motion::Quaternion(p.w, {}), motion::Quaternion(0, 0.5 * p.xyz)};
}

Result<void> append_curve(const motion::BSpline<HomogeneousPoint>& curve, motion::Move like, Vec3 end_mm,
                          State& state, Output& output) {
    motion::BSplineMotion motion;
    motion.spline.degree = curve.degree;
    motion.spline.knots = curve.knots;
    motion.spline.control.reserve(curve.control.size());
    for (const HomogeneousPoint& p : curve.control) motion.spline.control.push_back(translation(p));
    const double duration = like.duration_s;
    like.duration_s = 0;
    std::vector<motion::Move> moves;
    const std::size_t most = output.options.max_moves - output.moves;
    if (!motion::append_moves(motion, motion.start(), motion.end(), like, {}, most, moves))
        return output.refuse_more_moves(like.line);
    if (moves.empty()) return {};
    moves.front().start.tip_mm = state.tip_mm;
    moves.back().end.tip_mm = end_mm;
    double whole = 0;
    for (const motion::Move& move : moves) whole += motion::path_length_mm(move);
    for (motion::Move& move : moves) {
        move.duration_s = duration * (motion::path_length_mm(move) / whole);
        if (duration > 0) move.feed_mm_per_min = 60 * whole / duration;
        if (auto done = append(move, state, output); !done) return done;
    }
    state.tip_mm = end_mm;
    return {};
}

Result<void> require_xy(Command& command, const State& state, const Output& output) {
    if (state.plane == Plane::xy) return {};
    return output.refuse(command.line(), motion_column(command), "a spline lies in the XY plane only",
                         "write G17 before it");
}

motion::BSpline<HomogeneousPoint> bezier(std::initializer_list<Vec3> points) {
    motion::BSpline<HomogeneousPoint> curve;
    curve.degree = points.size() - 1;
    curve.knots.assign(points.size(), 0);
    curve.knots.insert(curve.knots.end(), points.size(), 1);
    for (const Vec3& p : points) curve.control.push_back({p, 1});
    return curve;
}

Result<double> weight_word(Command& command, char letter, const Output& output) {
    const Word* word = command.use(letter);
    if (word == nullptr) return 1.0;
    if (auto good = in_range(kLimits.weight, word->value, command, *word, output); !good)
        return std::unexpected(good.error());
    return word->value;
}

Result<void> begin_nurbs(Command& command, State& state, Output& output) {
    if (auto known = require_start(command, state, output); !known) return known;
    Nurbs& nurbs = state.nurbs;
    nurbs = {};
    nurbs.runs = true;
    nurbs.has_knots = state.motion == MotionMode::nurbs_with_knots;
    nurbs.line = command.line();
    nurbs.column = motion_column(command);
    nurbs.order = nurbs.has_knots ? 4 : 3;
    nurbs.last_mm = state.tip_mm;
    // The tip is the first control point of a G5.2. Its weight is the P word of a block without X and Y.
    if (nurbs.has_knots) return {};
    double weight = 1;
    if (!command.has_any("XY")) {
        const auto read = weight_word(command, 'P', output);
        if (!read) return std::unexpected(read.error());
        weight = *read;
    }
    nurbs.control.push_back({weight * state.tip_mm, weight});
    return {};
}

Result<void> read_order(Command& command, char letter, State& state, const Output& output) {
    const Word* word = command.use(letter);
    if (word == nullptr) return {};
    const bool fits = word->value >= 2 && word->value <= static_cast<double>(kHighestOrder) &&
                      word->value == std::floor(word->value);
    if (!fits) {
        return output.refuse(command.line(), word->column,
                             "the order of a B-spline is not a whole number from 2 to 10",
                             std::string("correct ") + letter + "; 3 is quadratic, 4 cubic");
    }
    state.nurbs.order = static_cast<std::size_t>(word->value);
    return {};
}

Result<void> add_control_point(Command& command, char weight_letter, State& state, Output& output) {
    Nurbs& nurbs = state.nurbs;
    const auto read = weight_word(command, weight_letter, output);
    if (!read) return std::unexpected(read.error());
    const double weight = *read;
    Vec3 point = nurbs.last_mm;
    for (int axis = 0; axis < 3; ++axis) {
        const auto coordinate = coordinate_mm(command, axis, state, output);
        if (!coordinate) return std::unexpected(coordinate.error());
        if (*coordinate) point[axis] = **coordinate + state.origin_mm()[axis];
    }
    if (nurbs.control.size() == kMostControlPoints) {
        return output.refuse(command.line(), 1, "a B-spline has more than 100000 control points", "split it");
    }
    if (nurbs.has_knots && nurbs.control.empty()) {
        const double gap = distance(point, state.tip_mm);
        if (gap > kJoinMm) {
            return output.refuse(
                command.line(), motion_column(command),
                "the first control point of the B-spline lies " + short_decimal(gap) + " mm from the tip",
                "move there first");
        }
        point = state.tip_mm;
    }
    nurbs.control.push_back({weight * point, weight});
    nurbs.last_mm = point;
    return {};
}

std::unexpected<Error> refuse_nurbs(const State& state, const Output& output, std::string cause,
                                    std::string remedy) {
    return output.refuse(state.nurbs.line, state.nurbs.column, std::move(cause), std::move(remedy));
}

// Clamped, with uniform steps inside, as LinuxCNC uses for G5.2.
std::vector<double> uniform_knots(std::size_t points, std::size_t order) {
    std::vector<double> knots(order, 0);
    const std::size_t pieces = points - order + 1;
    for (std::size_t i = 1; i < pieces; ++i) knots.push_back(static_cast<double>(i));
    knots.insert(knots.end(), order, static_cast<double>(pieces));
    return knots;
}

}  // namespace

Result<void> run_bezier(Command& command, State& state, Output& output) {
    const bool is_cubic = state.motion == MotionMode::cubic_spline;
    const char* const name = is_cubic ? "G5" : "G5.1";
    if (auto flat = require_xy(command, state, output); !flat) return flat;
    if (auto known = require_start(command, state, output); !known) return known;
    if (const Word* word = command.use('Z')) {
        return output.refuse(command.line(), word->column, std::string(name) + " has no motion along Z",
                             "move Z in a block of its own");
    }
    const auto first = offset_words(command, "IJ", state, output);
    if (!first) return std::unexpected(first.error());
    const auto second = is_cubic ? offset_words(command, "PQ", state, output) : std::optional<Vec3>{};
    if (!second) return std::unexpected(second.error());
    const auto target = target_of(command, state, output);
    if (!target) return std::unexpected(target.error());
    const Vec3 start = state.tip_mm, end = target->tip_mm;

    if (!is_cubic) {
        if (!*first) {
            return output.refuse(command.line(), motion_column(command), "G5.1 without its control point",
                                 "add I and J, counted from the start");
        }
        const Vec3 control = start + **first;
        const auto curve = bezier({start, control, end});
        motion::Move piece;
        piece.start.tip_mm = start;
        piece.end.tip_mm = end;
        piece.quadratic = motion::Quadratic{control, piece.start.axis};
        auto like = like_of(motion::path_length_mm(piece), command, state, output);
        if (!like) return std::unexpected(like.error());
        return append_curve(curve, *like, end, state, output);
    }
    if (!*second) {
        return output.refuse(command.line(), motion_column(command), "G5 without its second control point",
                             "add P and Q, counted from the end");
    }
    if (!*first && !state.spline_end_mm) {
        return output.refuse(
            command.line(), motion_column(command), "G5 without its first control point",
            "add I and J, counted from the start; they may be left out only after another G5");
    }
    const Vec3 first_control = start + (*first ? **first : -*state.spline_end_mm);
    const Vec3 second_control = end + **second;
    const auto curve = bezier({start, first_control, second_control, end});
    auto like = like_of(1, command, state, output);
    if (!like) return std::unexpected(like.error());
    state.spline_end_mm = **second;
    return append_curve(curve, *like, end, state, output);
}

Result<void> add_to_nurbs(Command& command, State& state, Output& output) {
    const bool begins = !state.nurbs.runs;
    if (begins) {
        if (state.motion == MotionMode::nurbs) {
            if (auto flat = require_xy(command, state, output); !flat) return flat;
        }
        if (state.incremental) {
            return output.refuse(command.line(), motion_column(command),
                                 "control points of a B-spline in increments (G91) are not read",
                                 "write them in absolute coordinates (G90)");
        }
        if (state.feed_mode == FeedMode::inverse_time) {
            return output.refuse(command.line(), motion_column(command),
                                 "a B-spline in inverse time (G93) has no feed", "write G94 and F before it");
        }
        if (auto begun = begin_nurbs(command, state, output); !begun) return begun;
    }
    Nurbs& nurbs = state.nurbs;
    if (begins || command.has('F')) {
        auto like = like_of(1, command, state, output);
        if (!like) return std::unexpected(like.error());
        nurbs.like = *like;
        nurbs.like.line = nurbs.line;
    }
    if (!nurbs.has_knots) {
        if (auto done = read_order(command, 'L', state, output); !done) return done;
        if (const Word* word = command.use('Z')) {
            return output.refuse(command.line(), word->column, "G5.2 has no motion along Z",
                                 "move Z in a block of its own");
        }
        if (!command.has_any("XY")) return {};
        if (!command.has('X') || !command.has('Y')) {
            return output.refuse(command.line(), column_of_any(command, "XY"),
                                 "a control point of G5.2 without both X and Y", "add the other one");
        }
        return add_control_point(command, 'P', state, output);
    }
    if (begins) {
        if (auto done = read_order(command, 'P', state, output); !done) return done;
        command.use('Q');  // feed control along the curve; it is ignored
    }
    const Word* knot = command.use('K');
    if (knot == nullptr) {
        return output.refuse(command.line(), motion_column(command), "a block of G6.2 without its knot",
                             "add K");
    }
    if (std::abs(knot->value) > kLargestKnot || (!nurbs.knots.empty() && knot->value < nurbs.knots.back())) {
        return output.refuse(command.line(), knot->column, "the knots of the B-spline do not ascend",
                             "correct K");
    }
    nurbs.knots.push_back(knot->value);
    return command.has_any("XYZR") ? add_control_point(command, 'R', state, output) : Result<void>{};
}

Result<void> finish_nurbs(State& state, Output& output) {
    Nurbs& nurbs = state.nurbs;
    if (!nurbs.runs) return {};
    nurbs.runs = false;
    const std::size_t points = nurbs.control.size(), order = nurbs.order;
    if (points < order) {
        return refuse_nurbs(state, output,
                            "a B-spline of order " + std::to_string(order) + " has only " +
                                std::to_string(points) + " control points",
                            "add control points or lower the order");
    }
    motion::BSpline<HomogeneousPoint> curve;
    curve.degree = order - 1;
    curve.knots = nurbs.has_knots ? std::move(nurbs.knots) : uniform_knots(points, order);
    curve.control = std::move(nurbs.control);
    nurbs.knots.clear();
    nurbs.control.clear();
    if (curve.knots.size() != points + order) {
        return refuse_nurbs(state, output,
                            "a B-spline of order " + std::to_string(order) + " with " +
                                std::to_string(points) + " control points has " +
                                std::to_string(curve.knots.size()) + " knots and not " +
                                std::to_string(points + order),
                            "add or delete lines with K alone at its end");
    }
    if (!motion::is_valid(curve)) {
        return refuse_nurbs(
            state, output, "the knots of the B-spline do not hold its ends or tear it apart",
            "write the first and the last knot as often as the order says, others less often");
    }
    const Vec3 end = nurbs.last_mm;
    return append_curve(curve, nurbs.like, end, state, output);
}

Result<void> close_nurbs_before(const Command& command, State& state, Output& output) {
    if (!state.nurbs.runs) return {};
    const auto code = command.g(GGroup::motion);
    const auto other = command.g(GGroup::non_modal);
    const bool goes_on = !other && (!code || code->tenths == (state.nurbs.has_knots ? 62 : 52));
    if (goes_on) return {};
    if (code && code->tenths == 53 && !state.nurbs.has_knots) return {};
    if (state.nurbs.has_knots) return finish_nurbs(state, output);
    return output.refuse(
        command.line(), code ? code->column : other->column,
        "the B-spline that G5.2 has begun in line " + std::to_string(state.nurbs.line) + " is not ended yet",
        "write G5.3 before this block");
}

}  // namespace tribo::readers::gcode
