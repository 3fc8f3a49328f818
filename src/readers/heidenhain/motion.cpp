// SPDX-License-Identifier: MIT
// Lines, the way to a target, and what every path function does.
#include <cmath>

#include "base/math.hpp"
#include "readers/gcode/motion/arc.hpp"
#include "readers/heidenhain/interpreter.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr std::string_view kPathAxes = "XYZ", kRotary = "ABC";

}  // namespace

Result<Vec3> Interpreter::target(const Words& words) {
    Vec3 to = here();
    std::array<Known, 3> known{path_.known(0), path_.known(1), path_.known(2)};
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (words.axis[i]) {
            to[k] = *words.axis[i];
            known[i] = Known::yes;
        } else if (words.increment[i]) {
            if (known[i] == Known::lost) continue;
            if (known[i] != Known::yes) {
                return path_.refuse(
                    place(words.first_column),
                    std::string("an increment along ") + kPathAxes[i] + " from an unknown place",
                    "write its coordinate before");
            }
            to[k] += *words.increment[i];
        }
    }
    if (path_.knows_tip()) return to;
    path_.put(to, known, line_.number);
    return to;
}

// Scale of lengths in the plane of the contour.
double Interpreter::plane_scale() const {
    return std::abs(scale_.x);
}

// A turn in the plane as the frame sees it: a mirror turns it round.
int Interpreter::turning(int direction, gcode::Plane plane) const {
    const auto axes = gcode::axes_of(plane);
    return mirror_[axes[0]] * mirror_[axes[1]] < 0 ? -direction : direction;
}

// LP, CP and CTP: about the pole.
Result<Vec3> Interpreter::polar_target(const Words& words) {
    const Place where = place(words.first_column);
    if (!pole_) return path_.refuse(where, "polar coordinates without a pole", "write CC before");
    const auto axes = gcode::axes_of(pole_plane_);
    const int u = axes[0], v = axes[1];
    const double scale_u = scale_[u] * mirror_[u], scale_v = scale_[v] * mirror_[v];
    const Vec3 from = here() - *pole_;
    const double from_u = from[u] / scale_u, from_v = from[v] / scale_v;
    double radius = math::hypot(from_u, from_v), angle = math::atan2(from_v, from_u) * math::kDegPerRad;
    if (words.polar_radius) radius = *words.polar_radius + (words.polar_radius_increment ? radius : 0);
    if (words.polar_angle) angle = *words.polar_angle;
    if (words.polar_turn) angle += *words.polar_turn;
    if (auto good = path_.in_range(kLimits.coordinate, radius, where); !good)
        return std::unexpected(good.error());
    if (auto good = path_.in_range(kLimits.rotary_angle, angle, where); !good)
        return std::unexpected(good.error());
    auto to = target(words);
    if (!to) return to;
    (*to)[u] = (*pole_)[u] + scale_u * radius * math::cos(angle * math::kRadPerDeg);
    (*to)[v] = (*pole_)[v] + scale_v * radius * math::sin(angle * math::kRadPerDeg);
    if (!path_.knows_tip()) {
        std::array<Known, 3> known{path_.known(0), path_.known(1), path_.known(2)};
        known[static_cast<std::size_t>(u)] = known[static_cast<std::size_t>(v)] = Known::yes;
        path_.put(*to, known, line_.number);
    }
    return to;
}

Result<Vec3> Interpreter::rotary_target(const Words& words) {
    Vec3 to = path_.rotary_rad();
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (!words.rotary[i] && !words.turn[i]) continue;
        const std::string letter(1, kRotary[i]);
        // At zero there is nothing to turn.
        const bool turns = words.rotary[i].value_or(0) != 0 || words.turn[i].value_or(0) != 0;
        if (!path_.machine && !turns && !path_.program.has_rotary_words) continue;
        path_.note_machine_needed(line_.number, "rotary axes (A B C) mean nothing");
        if (!path_.machine) continue;
        if (!path_.machine->has_axis(kRotary[i])) {
            return path_.refuse(place(words.first_column),
                                "the machine " + path_.machine->machine().name + " has no axis " + letter,
                                "name the machine that the program is written for");
        }
        if (words.turn[i]) {
            to[k] += *words.turn[i] * math::kRadPerDeg;
            continue;
        }
        const double from = to[k];
        to[k] = *words.rotary[i] * math::kRadPerDeg;
        if (shortest_way_) to[k] += math::kTwoPi * std::floor((from - to[k]) / math::kTwoPi + 0.5);
    }
    return to;
}

// Only the machine knows where the tool is.
bool Interpreter::is_lost() const {
    return path_.known(0) == Known::lost || path_.known(1) == Known::lost || path_.known(2) == Known::lost;
}

// A move is left out, because it begins where only the machine knows.
void Interpreter::leave_out() {
    if (left_out_++ != 0) return;
    left_out_line_ = line_.number;
    left_out_since_ = path_.lost_line();
}

// Takes coordinates that nothing has stated as 0.
void Interpreter::assume_start() {
    if (path_.knows_tip()) return;
    if (path_.first(kUnstatedAxes)) {
        path_.warn(line_.number, "feed move before all of X, Y and Z are stated: the others are taken as 0");
    }
    Vec3 from = path_.tip();
    for (int k = 0; k < 3; ++k) {
        if (path_.known(k) != Known::yes) from[k] = 0;
    }
    path_.put(from, {Known::yes, Known::yes, Known::yes}, line_.number);
}

// Returns false if the tool is where only the machine knows: the move of the words is left out then, and the
// tool is at its end. So is it before the first move, if that states all coordinates.
Result<bool> Interpreter::has_start(const Words& words, bool polar) {
    const bool states_all = words.axis[0] && words.axis[1] && words.axis[2];
    const bool begins_anywhere = path_.moves == 0 && !path_.knows_tip() && states_all;
    if (!is_lost() && !begins_anywhere) {
        assume_start();
        return true;
    }
    leave_out();
    const auto to_rad = rotary_target(words);
    if (!to_rad) return std::unexpected(to_rad.error());
    path_.set_rotary(*to_rad);
    const auto to = polar ? polar_target(words) : target(words);
    if (!to) return std::unexpected(to.error());
    if (auto done = apply_feed(words); !done) return std::unexpected(done.error());
    if (auto done = choose_side(words); !done) return std::unexpected(done.error());
    if (auto done = miscellaneous(words); !done) return std::unexpected(done.error());
    return false;
}

// Before a feed move: its feed, and the spindle.
Result<void> Interpreter::check_start(bool rapid) {
    if (rapid) return {};
    if (!path_.feed_mm_per_min && path_.options.default_feed_mm_per_min > 0) {
        path_.feed_mm_per_min = path_.options.default_feed_mm_per_min;
        path_.warn(line_.number, "no feed rate so far: " + short_decimal(*path_.feed_mm_per_min) +
                                     " mm/min is taken; write F before it, or another feed_mm_per_min");
    }
    if (!path_.spindle_on && path_.first(kSpindleOff)) {
        path_.warn(line_.number, "feed move with the spindle off: it is taken as running (M3)");
    }
    if (path_.spindle_on && path_.spindle_stands && path_.first(kSpindleStands)) {
        path_.warn(line_.number,
                   "feed move with S0: the spindle stands still; it is taken as turning at the job's speed");
    }
    return {};
}

// Adds a move from a known tip; `to` in the frame.
Result<void> Interpreter::go(bool rapid, Vec3 to, const std::optional<motion::Arc>& arc, Vec3 to_rad) {
    const bool stands = !arc && to == path_.tip() && to_rad == path_.rotary_rad();
    if (auto done = check_start(rapid || stands); !done) return done;
    return path_.move(rapid ? motion::MoveKind::rapid : motion::MoveKind::feed, to, arc, to_rad,
                      place(line_.column));
}

// Runs one path function: feed and functions, the move, and the cycle of M89.
Result<void> Interpreter::travel(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc,
                                 Vec3 to_rad) {
    if (auto done = apply_feed(words); !done) return done;
    if (captured_) {
        keep_step(words, to, arc);
        return {};
    }
    if (words.machine_position) {
        if (auto done = choose_side(words); !done) return done;
        if (auto done = close_contour(); !done) return done;
        contour_.leave();
        path_.lose(line_.number);
        path_.set_rotary(to_rad);
        if (path_.first(kMachinePosition)) {
            path_.warn(line_.number,
                       "M91 and M92 go to places that only the machine knows: the path is left out until X, "
                       "Y and Z are known again");
        }
        return miscellaneous(words);
    }
    if (!path_.knows_tip()) {  // some coordinates are not stated yet: no move
        path_.set_rotary(to_rad);
        if (auto done = choose_side(words); !done) return done;
        return miscellaneous(words);
    }
    const Vec3 from = here();
    const auto taken = add_to_contour(words, to, arc, to_rad != path_.rotary_rad());
    if (!taken) return std::unexpected(taken.error());
    if (!*taken) {
        // After radius compensation the tool stands beside the programmed place until it moves in the plane.
        const bool beside = contour_.programmed() && !arc && to.x == from.x && to.y == from.y;
        Vec3 tip_to = to;
        if (beside) {
            tip_to.x = path_.tip().x;
            tip_to.y = path_.tip().y;
            contour_.stay_at(to);
        } else {
            contour_.leave();
        }
        if (auto done = go(words.fast, tip_to, arc, to_rad); !done) return done;
    }
    last_was_rapid_ = words.fast;
    if (!arc && distance(from, to) > 0) tangent_ = normalized(to - from);
    if (arc) {
        const Vec3 radius = to - arc->centre_mm;
        tangent_ = normalized(cross(arc->normal, radius - dot(radius, arc->normal) * arc->normal));
    }
    if (auto done = miscellaneous(words); !done) return done;
    return cycle_at_every_position_ ? run_cycle(place(line_.column)) : Result<void>{};
}

Result<void> Interpreter::line(LineReader& in, bool polar) {
    const auto words = read_words(in, polar ? "LP" : "L");
    if (!words) return std::unexpected(words.error());
    bool moves = polar;
    for (std::size_t k = 0; k < 3; ++k) moves = moves || words->axis[k] || words->increment[k];
    // M128 and M129 act at the start of their block. The tool stands still when they switch.
    for (const int m : words->m) {
        if (m == 3 || m == 4 || m == 13 || m == 14) path_.spindle_on = true;
        if (m != 128 || !path_.machine) continue;
        if (auto done = close_contour(); !done) return done;
        path_.switch_tip_control(true, line_.number);
    }
    if (words->machine_position) {
        if (auto done = move_parallel_axes(*words); !done) return done;
        const auto to_rad = rotary_target(*words);
        return to_rad ? travel(*words, here(), {}, *to_rad) : std::unexpected(to_rad.error());
    }
    const bool known = path_.knows_tip();
    if (!known && !words->fast && moves) {
        const auto has = has_start(*words, polar);
        if (!has) return std::unexpected(has.error());
        if (!*has) return {};
    }
    const auto to_rad = rotary_target(*words);
    if (!to_rad) return std::unexpected(to_rad.error());
    const auto to = polar ? polar_target(*words) : target(*words);
    if (!to) return std::unexpected(to.error());
    if (auto done = move_parallel_axes(*words); !done) return done;
    return travel(*words, *to, {}, *to_rad);
}

// U V W: axes beside X Y Z, such as the quill of a boring mill. At a place of the machine they count as 0.
Result<void> Interpreter::move_parallel_axes(const Words& words) {
    for (int k = 0; k < 3; ++k) {
        const auto& mm = words.parallel[k];
        if (!mm) continue;
        if (captured_ || words.side.value_or(side_) != 0) {
            return path_.refuse(place(words.first_column),
                                std::string(1, "UVW"[k]) + " moves within a contour: that is not read",
                                "let the CAM system write the path with X, Y and Z");
        }
        if (auto done = close_contour(); !done) return done;
        contour_.leave();
        const double to_mm = words.machine_position ? 0 : *mm;
        if (auto done = path_.place_parallel(k, to_mm, place(words.first_column)); !done) return done;
    }
    return {};
}

// LN X Y Z NX NY NZ TX TY TZ: tip and tool axis, independent of the machine.
Result<void> Interpreter::line_with_vectors(LineReader& in) {
    const auto words = read_words(in, "LN");
    if (!words) return std::unexpected(words.error());
    if (!words->fast) {
        const auto has = has_start(*words, false);
        if (!has) return std::unexpected(has.error());
        if (!*has) return {};
    }
    if (auto done = close_contour(); !done) return done;
    const auto to = target(*words);
    if (!to) return std::unexpected(to.error());
    Vec3 axis = path_.axis();
    if (words->vector[0] || words->vector[1] || words->vector[2]) {
        axis = {words->vector[0].value_or(0), words->vector[1].value_or(0), words->vector[2].value_or(0)};
        if (!(length(axis) > 1e-6)) {
            return in.refuse(words->first_column, "the tool's axis TX TY TZ has no direction", "correct it");
        }
        axis = normalized(path_.frame.direction_in_stock(axis));
    }
    Vec3 to_rad = path_.rotary_rad();
    if (path_.machine) {
        path_.switch_tip_control(true, line_.number);
        const auto reached = path_.machine->kinematics().joints({{}, axis}, {{}, to_rad});
        if (!reached) {
            return in.refuse(words->first_column,
                             "the machine " + path_.machine->machine().name + " cannot turn its tool there",
                             "name the machine that the program is written for");
        }
        to_rad = reached->joints.rotary_rad;
    }
    path_.aim(axis);
    return travel(*words, *to, {}, to_rad);
}

}  // namespace tribo::readers::heidenhain
