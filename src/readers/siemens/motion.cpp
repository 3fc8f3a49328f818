// SPDX-License-Identifier: MIT
// Where a block goes, and how.
#include <cmath>

#include "base/math.hpp"
#include "motion/path/path.hpp"
#include "readers/siemens/interpreter.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr std::string_view kPathAxes = "XYZ";
// Lines with ANG: the angle may not lie along the coordinate that is given.
constexpr double kLeastSlope = 1e-6;

}  // namespace

Result<void> Interpreter::move(const Words& words) {
    if (!has_unit_ && path_.first(kNoUnit)) {
        path_.warn(line_number(), std::string("no G70, G71, G700 or G710 before the first move: ") +
                                      (unit_mm_ == 1 ? "millimetres are" : "inches are") + " taken");
    }
    if (auto done = orient(words); !done) return done;
    const bool is_arc = motion_ == Motion::clockwise || motion_ == Motion::counter_clockwise ||
                        motion_ == Motion::through_point || motion_ == Motion::tangent;
    if (words.has_centre() && !is_arc) {
        return path_.refuse(place(words.first_column), "I, J or K without a circle to use it",
                            "write G2 or G3 before it, or delete the word");
    }
    Vec3 to;
    const auto known = find_target(words, to);
    if (!known) return std::unexpected(known.error());
    if (auto done = move_parallel_axes(words); !done) return done;
    if (!*known) {
        path_.set_rotary(target_rad_);
        contour_.leave();
        tangent_ = {};
        return run_modal();
    }
    if (motion_ == Motion::poly) {
        if (auto done = run_polynomial(words, to); !done) return done;
        return run_modal();
    }
    if (motion_ == Motion::bspline || motion_ == Motion::akima || motion_ == Motion::cubic)
        return add_to_spline(words, to);
    std::optional<motion::Arc> arc;
    if (is_arc && !words.positions) {
        // A machine turns its axes evenly along the circle (Job Planning 02/2011, 6.2.3).
        if (turns_ && !path_.machine) {
            return path_.refuse(place(words.first_column), "the tool turns along a circle",
                                "name the machine, or let the CAM system write short lines");
        }
        const auto found = circle(words, to);
        if (!found) return std::unexpected(found.error());
        arc = *found;
    }
    if (auto done = travel(words, to, arc); !done) return done;
    return run_modal();
}

// Before a feed move from a place that no block states.
void Interpreter::assume_start() {
    std::array<Known, 3> known{path_.known(0), path_.known(1), path_.known(2)};
    for (const Known axis : known) {
        if (axis == Known::lost) return;
    }
    if (path_.knows_tip()) return;
    if (path_.first(kUnstatedAxes)) {
        path_.warn(line_number(), "feed move before all of X, Y and Z are stated: the others are taken as 0");
    }
    Vec3 from = path_.tip();
    for (int k = 0; k < 3; ++k) {
        if (path_.known(k) != Known::yes) from[k] = 0;
    }
    path_.put(from, {Known::yes, Known::yes, Known::yes}, line_number());
}

// Finds the end of the block in the frame. Returns false if the tool does not move, because only the machine
// knows where it starts: its coordinates are known then as far as the block says them.
Result<bool> Interpreter::find_target(const Words& words, Vec3& to) {
    // Where the first move comes from, only the machine knows.
    const bool states_all = words.linear[0] && words.linear[1] && words.linear[2];
    const bool begins_anywhere = path_.moves == 0 && !incremental_ && states_all;
    if (!is_rapid(words) && !begins_anywhere) assume_start();
    to = here();
    std::array<Known, 3> known{path_.known(0), path_.known(1), path_.known(2)};
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (!words.linear[i]) continue;
        const Amount& word = *words.linear[i];
        const double mm = word.value * unit_mm_;
        if (auto good = path_.in_range(kLimits.coordinate, mm, place(word.column)); !good)
            return std::unexpected(good.error());
        const bool adds =
            word.measure == Measure::incremental || (word.measure == Measure::modal && incremental_);
        if (adds && known[i] != Known::yes) {
            return path_.refuse(place(word.column),
                                std::string("an increment along ") + kPathAxes[i] + " from an unknown place",
                                "write its coordinate before");
        }
        to[k] = scale_[k] * mm + (adds ? to[k] : 0);
        known[i] = Known::yes;
    }
    if (words.has_polar()) {
        if (auto done = polar_target(words, to); !done) return std::unexpected(done.error());
        known[static_cast<std::size_t>(axes()[0])] = known[static_cast<std::size_t>(axes()[1])] = Known::yes;
    }
    if (words.direction) {
        if (auto done = angled_target(words, to); !done) return std::unexpected(done.error());
    }
    if (path_.knows_tip()) return true;
    const bool moves = words.has_linear() || words.has_polar();
    path_.put(to, known, line_number());
    if (!is_rapid(words) && moves) {
        if (left_out_++ == 0) left_out_line_ = line_number();
    }
    return false;
}

// U V W: axes beside X Y Z, such as the quill of a boring mill.
Result<void> Interpreter::move_parallel_axes(const Words& words) {
    for (int k = 0; k < 3; ++k) {
        const auto& word = words.parallel[static_cast<std::size_t>(k)];
        if (!word) continue;
        const double from = path_.parallel_mm(k);
        const bool adds =
            word->measure == Measure::incremental || (word->measure == Measure::modal && incremental_);
        const double to = word->value * unit_mm_ + (adds ? from : 0);
        if (to == from) continue;
        const bool is_straight = motion_ == Motion::rapid || motion_ == Motion::line;
        if (!is_straight || captured_ || side_ != 0) {
            return path_.refuse(
                place(word->column),
                std::string(1, "UVW"[k]) + " moves within a contour or curve: that is not read",
                "let the CAM system write the path with X, Y and Z");
        }
        if (auto done = close_contour(); !done) return done;
        contour_.leave();
        if (auto done = path_.place_parallel(k, to, place(word->column)); !done) return done;
    }
    return {};
}

// AP= and RP= about the pole; one that is missing stays as it is.
Result<void> Interpreter::polar_target(const Words& words, Vec3& to) {
    const auto [u, v, w] = axes();
    const Vec3 pole = pole_.value_or(Vec3{});
    const double from_u = (here()[u] - pole[u]) / scale_[u], from_v = (here()[v] - pole[v]) / scale_[v];
    double radius = math::hypot(from_u, from_v), angle = math::atan2(from_v, from_u) * math::kDegPerRad;
    if (words.polar_radius) {
        const bool adds = words.polar_radius->measure == Measure::incremental;
        radius = words.polar_radius->value * unit_mm_ + (adds ? radius : 0);
        if (auto good = path_.in_range(kLimits.coordinate, radius, place(words.polar_radius->column)); !good)
            return good;
    }
    if (words.polar_angle) {
        const bool adds = words.polar_angle->measure == Measure::incremental ||
                          (words.polar_angle->measure == Measure::modal && incremental_);
        angle = words.polar_angle->value + (adds ? angle : 0);
        if (auto good = path_.in_range(kLimits.rotary_angle, angle, place(words.polar_angle->column)); !good)
            return good;
    }
    to[u] = pole[u] + scale_[u] * radius * math::cos(angle * math::kRadPerDeg);
    to[v] = pole[v] + scale_[v] * radius * math::sin(angle * math::kRadPerDeg);
    return {};
}

// ANG= with one coordinate of the plane: the other follows.
Result<void> Interpreter::angled_target(const Words& words, Vec3& to) {
    const auto [u, v, w] = axes();
    const bool has_u = words.linear[static_cast<std::size_t>(u)].has_value();
    const bool has_v = words.linear[static_cast<std::size_t>(v)].has_value();
    const double c = math::cos(*words.direction * math::kRadPerDeg),
                 s = math::sin(*words.direction * math::kRadPerDeg);
    if (has_u == has_v || std::abs(has_u ? c : s) < kLeastSlope ||
        std::abs(scale_[u]) != std::abs(scale_[v])) {
        return path_.refuse(place(words.first_column), "ANG without one coordinate that fixes the end",
                            "write both coordinates instead");
    }
    const double sign = scale_[u] * scale_[v] < 0 ? -1 : 1;
    if (has_u) to[v] = here()[v] + sign * (to[u] - here()[u]) * s / c;
    if (has_v) to[u] = here()[u] + sign * (to[v] - here()[v]) * c / s;
    for (const int k : {u, v}) {
        if (auto good = path_.in_range(kLimits.coordinate, to[k], place(words.first_column)); !good)
            return good;
    }
    return {};
}

// SUPA, G53, G74, G75: to places that only the machine knows.
Result<void> Interpreter::leave_for_machine(const Words& words) {
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    tangent_ = {};
    if (auto done = orient(words); !done) return done;
    path_.set_rotary(target_rad_);
    for (int k = 0; k < 3; ++k) {
        if (!words.parallel[static_cast<std::size_t>(k)]) continue;
        if (auto done = path_.place_parallel(k, 0, place(words.first_column)); !done) return done;
    }
    if (!words.has_linear() && !words.has_parallel()) return {};
    if (path_.first(kMachinePlace)) {
        path_.warn(line_number(),
                   "SUPA, G53, G74 and G75 go to places that only the machine knows: the path is left out "
                   "until X, Y and Z are known again");
    }
    const bool is_straight =
        path_.frame.x == Vec3{1, 0, 0} && path_.frame.z == Vec3{0, 0, 1} && !path_.machine;
    if (!is_straight) {
        path_.lose(line_number());
        return {};
    }
    std::array<Known, 3> known{path_.known(0), path_.known(1), path_.known(2)};
    for (std::size_t k = 0; k < 3; ++k) {
        if (words.linear[k] || words.parallel[k]) known[k] = Known::lost;
    }
    path_.put(path_.tip(), known, line_number());
    return {};
}

// Before a move: the spindle.
void Interpreter::check_start(bool rapid) {
    if (rapid) return;
    if (!path_.feed_mm_per_min && path_.options.default_feed_mm_per_min > 0) {
        path_.feed_mm_per_min = path_.options.default_feed_mm_per_min;
        path_.warn(line_number(), "no feed rate so far: " + short_decimal(*path_.feed_mm_per_min) +
                                      " mm/min is taken; write F before it, or another feed_mm_per_min");
    }
    if (!path_.spindle_on && path_.first(kSpindleOff)) {
        path_.warn(line_number(), "feed move with the spindle off: it is taken as running (M3)");
    }
    if (path_.spindle_on && path_.spindle_stands && path_.first(kSpindleStands)) {
        path_.warn(line_number(),
                   "feed move with S0: the spindle stands still; it is taken as turning at the job's speed");
    }
}

// Adds a move from a known tip; `to` in the frame.
Result<void> Interpreter::go(bool rapid, Vec3 to, const std::optional<motion::Arc>& arc, Vec3 to_rad) {
    const bool stands = !arc && to == path_.tip() && to_rad == path_.rotary_rad();
    check_start(rapid || stands);
    return path_.move(rapid ? motion::MoveKind::rapid : motion::MoveKind::feed, to, arc, to_rad, place(1));
}

// FB for this block, and G93: F is one over the minutes of the block.
Result<void> Interpreter::set_block_feed(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc) {
    if (words.block_feed) {
        const double feed = words.block_feed->value * unit_mm_;
        if (auto good = path_.in_range(kLimits.feed, feed, place(words.block_feed->column)); !good)
            return good;
        path_.feed_mm_per_min = feed;
    }
    if (feed_mode_ != 93 || is_rapid(words)) return {};
    if (!words.feed) {
        return path_.refuse(place(words.first_column), "G93 without F in its block", "write F in each block");
    }
    motion::Move like;
    like.start.tip_mm = here();
    like.end.tip_mm = to;
    like.arc = arc;
    double length = motion::path_length_mm(like);
    if (length == 0) length = tribo::length(target_rad_ - path_.rotary_rad()) * math::kDegPerRad;
    if (length == 0) return {};
    path_.feed_mm_per_min = feed_ * length;
    return {};
}

// Adds the move of a block.
Result<void> Interpreter::travel(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc) {
    const auto modal_feed = path_.feed_mm_per_min;
    if (auto done = set_block_feed(words, to, arc); !done) return done;
    const Vec3 from = here();
    const bool rapid = is_rapid(words);
    const auto taken = add_to_contour(words, to, arc);
    if (!taken) return std::unexpected(taken.error());
    if (!*taken) {
        // After radius compensation the tool stands beside the programmed place until it moves in the plane.
        const Vec3 from_in_plane = to_plane(from), to_in_plane = to_plane(to);
        const bool beside = contour_.programmed() && !arc && from_in_plane.x == to_in_plane.x &&
                            from_in_plane.y == to_in_plane.y;
        Vec3 tip_to = to;
        if (beside) {
            tip_to = path_.tip();
            tip_to[axes()[2]] = to[axes()[2]];
            contour_.stay_at(to_in_plane);
        } else {
            contour_.leave();
        }
        if (auto done = go(rapid, tip_to, arc, target_rad_); !done) return done;
    }
    if (words.block_feed || feed_mode_ == 93) path_.feed_mm_per_min = modal_feed;
    if (!arc && distance(from, to) > 0) tangent_ = normalized(to - from);
    if (arc) {
        const Vec3 radius = to - arc->centre_mm;
        tangent_ = normalized(cross(arc->normal, radius - dot(radius, arc->normal) * arc->normal));
    }
    return {};
}

}  // namespace tribo::readers::siemens
