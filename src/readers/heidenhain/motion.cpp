// SPDX-License-Identifier: MIT
// Path functions: lines, circles, poles, and their common words.
#include <cmath>

#include "base/math.hpp"
#include "readers/gcode/motion/arc.hpp"
#include "readers/heidenhain/interpreter.hpp"
#include "readers/text/decimal_text.hpp"
#include "readers/text/length_unit.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr std::string_view kAxes = "XYZ", kRotary = "ABC";
// Miscellaneous functions without effect on the simulation: coolant, clamps, feed of rotary axes, corner and
// look-ahead behaviour.
constexpr int kSilent[] = {0,   1,   6,   7,   8,   9,   25,  26,  27,  28,  90, 97,
                           101, 107, 108, 116, 117, 120, 124, 134, 135, 138, 141};

bool is_silent(int m) {
    for (const int silent : kSilent) {
        if (m == silent) return true;
    }
    return false;
}

}  // namespace

// Sorts the items of a path function; `own` is its name, for messages.
Result<Interpreter::Words> Interpreter::read_words(LineReader& in, std::string_view own) {
    Words words;
    words.first_column = in.column();
    if (auto done = in.items(words.items); !done) return std::unexpected(done.error());
    const auto place_of = [](std::string_view letters, std::string_view name) {
        return name.size() == 1 ? letters.find(name[0]) : std::string_view::npos;
    };
    for (const Item& item : words.items) {
        std::string_view name = item.name;
        const bool incremental = name.size() >= 2 && name[0] == 'I';
        if (incremental) name.remove_prefix(1);
        const std::size_t axis = place_of(kAxes, name), rotary = place_of(kRotary, name);
        const std::size_t vector =
            item.name.size() == 2 && item.name[0] == 'T' ? kAxes.find(item.name[1]) : std::string_view::npos;
        if (axis < 3 && item.value) {
            const double mm = *item.value * unit_mm_;
            if (auto good = in.in_range(kLimits.coordinate, mm, item.column); !good)
                return std::unexpected(good.error());
            (incremental ? words.increment : words.axis)[axis] = mm;
        } else if (rotary < 3 && item.value) {
            if (auto good = in.in_range(kLimits.rotary_angle, *item.value, item.column); !good)
                return std::unexpected(good.error());
            (incremental ? words.turn : words.rotary)[rotary] = *item.value;
        } else if (vector < 3 && item.value && own == "LN") {
            words.vector[vector] = *item.value;
        } else if (own == "LN" && item.value && item.name.size() == 2 && item.name[0] == 'N') {
            continue;  // the normal of the surface: used by radius compensation only
        } else if (name == "PR" && item.value) {
            words.polar_radius = *item.value * unit_mm_;
            words.polar_radius_increment = incremental;
        } else if (name == "PA" && item.value) {
            (incremental ? words.polar_turn : words.polar_angle) = *item.value;
        } else if (item.name == "DR" && item.sign != 0) {
            words.direction = item.sign;
        } else if (item.name == "R" && own == "CR" && item.value && !words.radius) {
            words.radius = *item.value * unit_mm_;
        } else if (item.name == "R" && item.value == 0.0) {
            continue;
        } else if (item.name == "RL" || item.name == "RR" || item.name == "R") {
            return in.refuse(item.column, "radius compensation (" + item.name + ") is not read yet",
                             "let the CAM system write the path of the tool's centre with R0");
        } else if (item.name == "FMAX") {
            words.fast = true;
        } else if (item.name == "F" || item.name == "FAUTO" || item.name == "AUTO" || item.name == "MAX") {
            continue;  // read by apply_feed
        } else if (item.name == "M" && item.value) {
            if (*item.value < 0 || *item.value > 999 || *item.value != std::floor(*item.value)) {
                return in.refuse(item.column, "M without a whole number", "correct it");
            }
            words.m.push_back(static_cast<int>(*item.value));
        } else if (item.name == "MB") {
            continue;
        } else {
            return in.refuse(item.column,
                             "'" + item.name + "' does not belong into " +
                                 (own == "M" ? "this block" : "a block ") +
                                 (own == "M" ? "" : std::string(own)),
                             "correct or delete it");
        }
    }
    for (std::size_t i = 0; i + 1 < words.items.size(); ++i) {
        if (words.items[i].name == "F" && words.items[i + 1].name == "MAX") words.fast = true;
    }
    for (const int m : words.m) words.machine_position = words.machine_position || m == 91 || m == 92;
    return words;
}

Result<void> Interpreter::apply_feed(const Words& words) {
    for (std::size_t i = 0; i < words.items.size(); ++i) {
        const Item& item = words.items[i];
        const bool automatic = item.name == "FAUTO" || (item.name == "F" && i + 1 < words.items.size() &&
                                                        words.items[i + 1].name == "AUTO");
        if (automatic) {
            if (!(tool_feed_ > 0)) {
                return path_.refuse(place(item.column), "F AUTO without a feed in TOOL CALL",
                                    "write F there");
            }
            path_.feed_mm_per_min = tool_feed_;
        } else if (item.name == "F" && item.value) {
            const double feed = *item.value * unit_mm_;
            if (auto good = path_.in_range(kLimits.feed, feed, place(item.column)); !good) return good;
            path_.feed_mm_per_min = feed;
        }
    }
    return {};
}

// Runs the miscellaneous functions of the block that act at its end, after the path function.
Result<void> Interpreter::miscellaneous(const Words& words) {
    bool call = false;
    for (const int m : words.m) {
        switch (m) {
            case 3:
            case 4:
            case 13:
            case 14:
                path_.spindle_on = true;
                break;
            case 5:
                path_.spindle_on = false;
                break;
            case 2:
            case 30:
                ended_ = true;
                break;
            case 89:
                cycle_at_every_position_ = true;
                break;
            case 99:
                call = true;
                break;
            case 91:
            case 92:
                break;
            case 94:
                path_.set_rotary({std::fmod(path_.rotary_rad().x, math::kTwoPi),
                                  std::fmod(path_.rotary_rad().y, math::kTwoPi),
                                  std::fmod(path_.rotary_rad().z, math::kTwoPi)});
                break;
            case 126:
            case 127:
                shortest_way_ = m == 126;
                break;
            case 128:
                if (!path_.machine) path_.note_machine_needed(line_.number, "tool tip control (M128)");
                path_.switch_tip_control(true, line_.number);
                break;
            case 129:
                path_.switch_tip_control(false, line_.number);
                break;
            case 140:
                path_.lose(line_.number);
                break;
            default:
                if (is_silent(m)) break;
                return path_.refuse(place(words.first_column), "M" + std::to_string(m) + " is not known",
                                    "delete it where it does not move the tool");
        }
    }
    return call ? call_cycle(place(words.first_column)) : Result<void>{};
}

Result<Vec3> Interpreter::target(const Words& words) {
    Vec3 to = path_.tip();
    std::array<Known, 3> known{path_.known(0), path_.known(1), path_.known(2)};
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (words.axis[i]) {
            to[k] = *words.axis[i];
            known[i] = Known::yes;
        } else if (words.increment[i]) {
            if (known[i] != Known::yes) {
                return path_.refuse(place(words.first_column),
                                    std::string("an increment along ") + kAxes[i] + " from an unknown place",
                                    "write its coordinate before");
            }
            to[k] += *words.increment[i];
        }
    }
    if (path_.knows_tip()) return to;
    path_.put(to, known, line_.number);
    return to;
}

// LP and CP: about the pole.
Result<Vec3> Interpreter::polar_target(const Words& words) {
    if (!pole_)
        return path_.refuse(place(words.first_column), "polar coordinates without a pole", "write CC before");
    const Vec3 from = path_.tip() - *pole_;
    double radius = math::hypot(from.x, from.y), angle = math::atan2(from.y, from.x) * math::kDegPerRad;
    if (words.polar_radius) radius = *words.polar_radius + (words.polar_radius_increment ? radius : 0);
    if (words.polar_angle) angle = *words.polar_angle;
    if (words.polar_turn) angle += *words.polar_turn;
    const Place where = place(words.first_column);
    if (auto good = path_.in_range(kLimits.coordinate, radius, where); !good)
        return std::unexpected(good.error());
    if (auto good = path_.in_range(kLimits.rotary_angle, angle, where); !good)
        return std::unexpected(good.error());
    auto to = target(words);
    if (!to) return to;
    to->x = pole_->x + radius * math::cos(angle * math::kRadPerDeg);
    to->y = pole_->y + radius * math::sin(angle * math::kRadPerDeg);
    return to;
}

Result<Vec3> Interpreter::rotary_target(const Words& words) {
    Vec3 to = path_.rotary_rad();
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (!words.rotary[i] && !words.turn[i]) continue;
        const std::string letter(1, kRotary[i]);
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

Result<void> Interpreter::require_start() {
    if (path_.knows_tip()) return {};
    for (int k = 0; k < 3; ++k) {
        if (path_.known(k) != Known::lost) continue;
        return path_.refuse(place(line_.column),
                            std::string("the feed move starts at an unknown ") +
                                kAxes[static_cast<std::size_t>(k)] + ", which line " +
                                std::to_string(path_.lost_line()) +
                                " moved to a place that only the machine knows",
                            "add a block with FMAX and X, Y and Z before it");
    }
    if (path_.first(kUnstatedAxes)) {
        path_.warn(line_.number, "feed move before all of X, Y and Z are stated: the others are taken as 0");
    }
    Vec3 from = path_.tip();
    for (int k = 0; k < 3; ++k) {
        if (path_.known(k) != Known::yes) from[k] = 0;
    }
    path_.put(from, {Known::yes, Known::yes, Known::yes}, line_.number);
    return {};
}

// Adds a move from a known tip; `to` in the frame.
Result<void> Interpreter::go(bool rapid, Vec3 to, const std::optional<motion::Arc>& arc, Vec3 to_rad) {
    const Place where = place(line_.column);
    if (!rapid) {
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
                       "feed move with S0: the spindle stands still; it is taken as turning at the job's "
                       "speed");
        }
    }
    return path_.move(rapid ? motion::MoveKind::rapid : motion::MoveKind::feed, to, arc, to_rad, where);
}

// Runs one path function: feed and functions, the move, and the cycle of M89.
Result<void> Interpreter::travel(const Words& words, Vec3 to, const std::optional<motion::Arc>& arc,
                                 Vec3 to_rad) {
    if (auto done = apply_feed(words); !done) return done;
    const Vec3 from = path_.tip();
    if (words.machine_position) {
        path_.lose(line_.number);
        path_.set_rotary(to_rad);
        if (path_.first(kMachinePosition)) {
            path_.warn(line_.number,
                       "M91 goes to a place that only the machine knows: the path is left out until X, "
                       "Y and Z are known again");
        }
        return miscellaneous(words);
    }
    if (!path_.knows_tip()) {  // some coordinates are not stated yet: no move
        path_.set_rotary(to_rad);
        return miscellaneous(words);
    }
    if (auto done = go(words.fast, to, arc, to_rad); !done) return done;
    if (!arc && distance(from, to) > 0) tangent_ = normalized(to - from);
    if (arc) {
        const Vec3 radius = to - arc->centre_mm;
        tangent_ = normalized(cross(arc->normal, {radius.x, radius.y, 0}));
    }
    if (auto done = miscellaneous(words); !done) return done;
    return cycle_at_every_position_ ? call_cycle(place(line_.column)) : Result<void>{};
}

Result<void> Interpreter::line(LineReader& in, bool polar) {
    const auto words = read_words(in, polar ? "LP" : "L");
    if (!words) return std::unexpected(words.error());
    bool moves = polar;
    for (std::size_t k = 0; k < 3; ++k) moves = moves || words->axis[k] || words->increment[k];
    // M128 and M129 act at the start of their block. The tool stands still when they switch.
    for (const int m : words->m) {
        if (m == 3 || m == 4 || m == 13 || m == 14) path_.spindle_on = true;
        if (m == 128 && path_.machine) path_.switch_tip_control(true, line_.number);
    }
    if (words->machine_position) {
        const auto to_rad = rotary_target(*words);
        return to_rad ? travel(*words, path_.tip(), {}, *to_rad) : std::unexpected(to_rad.error());
    }
    const bool known = path_.knows_tip();
    if (!known && !words->fast && moves) {
        if (auto done = require_start(); !done) return done;
    }
    const auto to_rad = rotary_target(*words);
    if (!to_rad) return std::unexpected(to_rad.error());
    const auto to = polar ? polar_target(*words) : target(*words);
    if (!to) return std::unexpected(to.error());
    return travel(*words, *to, {}, *to_rad);
}

// LN X Y Z NX NY NZ TX TY TZ: tip and tool axis, independent of the machine.
Result<void> Interpreter::line_with_vectors(LineReader& in) {
    const auto words = read_words(in, "LN");
    if (!words) return std::unexpected(words.error());
    if (!words->fast) {
        if (auto done = require_start(); !done) return done;
    }
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

// CC X Y sets the pole; CC alone sets it to the position of the tip.
Result<void> Interpreter::pole(LineReader& in) {
    const auto words = read_words(in, "CC");
    if (!words) return std::unexpected(words.error());
    Vec3 pole = words->items.empty() ? path_.tip() : pole_.value_or(path_.tip());
    for (int k = 0; k < 2; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (words->axis[i]) pole[k] = *words->axis[i];
        if (words->increment[i]) pole[k] = path_.tip()[k] + *words->increment[i];
    }
    if (words->axis[2] || words->increment[2]) {
        return in.refuse(words->first_column, "a pole outside the plane X Y is not read",
                         "write CC with X and Y");
    }
    pole_ = pole;
    return {};
}

Result<void> Interpreter::circle(LineReader& in) {
    const auto words = read_words(in, "C");
    if (!words) return std::unexpected(words.error());
    if (!pole_) return in.refuse(words->first_column, "a circle without a centre", "write CC before it");
    if (words->direction == 0) return in.refuse(words->first_column, "a circle without DR+ or DR-", "add it");
    if (auto done = require_start(); !done) return done;
    const auto to = target(*words);
    if (!to) return std::unexpected(to.error());
    gcode::ArcEnds ends;
    ends.clockwise = words->direction < 0;
    ends.start_mm = path_.tip();
    ends.end_mm = *to;
    const auto arc = gcode::arc_about_centre(ends, *pole_, unit_mm_);
    if (!arc)
        return in.refuse(words->first_column, arc.error().cause, "correct the end, or the centre in CC");
    return travel(*words, *to, *arc, path_.rotary_rad());
}

Result<void> Interpreter::circle_of_radius(LineReader& in) {
    const auto words = read_words(in, "CR");
    if (!words) return std::unexpected(words.error());
    if (!words->radius) return in.refuse(words->first_column, "CR without a radius R", "add it");
    if (words->direction == 0) return in.refuse(words->first_column, "CR without DR+ or DR-", "add it");
    if (auto done = require_start(); !done) return done;
    const auto to = target(*words);
    if (!to) return std::unexpected(to.error());
    gcode::ArcEnds ends;
    ends.clockwise = words->direction < 0;
    ends.start_mm = path_.tip();
    ends.end_mm = *to;
    const auto arc = gcode::arc_of_radius(ends, *words->radius);
    if (!arc) return in.refuse(words->first_column, arc.error().cause, arc.error().remedy);
    return travel(*words, *to, *arc, path_.rotary_rad());
}

// CT: an arc to the end, tangent to the last element.
Result<void> Interpreter::tangent_circle(LineReader& in) {
    const auto words = read_words(in, "CT");
    if (!words) return std::unexpected(words.error());
    if (auto done = require_start(); !done) return done;
    const Vec3 from = path_.tip(), along{tangent_.x, tangent_.y, 0};
    if (!(length(along) > 1e-9)) {
        return in.refuse(words->first_column, "CT with nothing before it to be tangent to",
                         "write L or C before it");
    }
    const auto to = target(*words);
    if (!to) return std::unexpected(to.error());
    // The centre is on the normal of the tangent at the start, at equal distances from start and end.
    const Vec3 t = normalized(along), normal{-t.y, t.x, 0}, chord{to->x - from.x, to->y - from.y, 0};
    const double across = dot(chord, normal);
    if (std::abs(across) <= 1e-9 * length(chord)) {
        return in.refuse(words->first_column, "the end of CT lies straight ahead: no arc leads there",
                         "write L");
    }
    const double radius = squared_length(chord) / (2 * across);
    if (!kLimits.coordinate.range.contains(radius)) {
        return in.refuse(words->first_column, "the radius of CT is more than a kilometre", "write L");
    }
    gcode::ArcEnds ends;
    ends.clockwise = radius < 0;
    ends.start_mm = from;
    ends.end_mm = *to;
    const auto arc = gcode::arc_about_centre(ends, from + radius * normal, unit_mm_);
    if (!arc) return in.refuse(words->first_column, arc.error().cause, "correct the end");
    return travel(*words, *to, *arc, path_.rotary_rad());
}

// CP PA or IPA, with Z or IZ a helix of any number of turns.
Result<void> Interpreter::polar_circle(LineReader& in) {
    const auto words = read_words(in, "CP");
    if (!words) return std::unexpected(words.error());
    if (words->direction == 0) return in.refuse(words->first_column, "CP without DR+ or DR-", "add it");
    if (!words->polar_angle && !words->polar_turn) {
        return in.refuse(words->first_column, "CP without an angle PA or IPA", "add it");
    }
    if (auto done = require_start(); !done) return done;
    const auto to = polar_target(*words);
    if (!to) return std::unexpected(to.error());
    const Vec3 from = path_.tip() - *pole_;
    if (!(math::hypot(from.x, from.y) > 1e-6)) {
        return in.refuse(words->first_column, "the arc starts in its pole", "correct CC");
    }
    double turn = words->polar_turn.value_or(0) * words->direction;
    if (words->polar_angle) {
        const double start = math::atan2(from.y, from.x) * math::kDegPerRad;
        turn = (*words->polar_angle - start) * words->direction;
        turn -= 360 * std::floor(turn / 360);
        if (turn < 1e-9) turn += 360;
    }
    if (!(turn > 0))
        return in.refuse(words->first_column, "IPA and DR turn different ways", "correct a sign");
    motion::Arc arc;
    arc.centre_mm = {pole_->x, pole_->y, path_.tip().z};
    arc.normal = {0, 0, static_cast<double>(words->direction)};
    arc.turn_rad = turn * math::kRadPerDeg;
    return travel(*words, *to, arc, path_.rotary_rad());
}

}  // namespace tribo::readers::heidenhain
