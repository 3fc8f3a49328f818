// SPDX-License-Identifier: MIT
// The words that path functions share: coordinates, feeds, radius compensation, miscellaneous functions.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.hpp"
#include "readers/heidenhain/interpreter.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr std::string_view kAxes = "XYZ", kParallel = "UVW", kRotary = "ABC";
// Miscellaneous functions without effect on the path: stop, tool change, coolant, clamps, feed of rotary axes
// and of circles, corner and look-ahead behaviour, limits of the machine.
constexpr int kSilent[] = {0,   1,   6,   7,   8,   9,   25,  26,  27,  28,  90,  97,  98,  101, 103, 107,
                           108, 109, 110, 111, 112, 113, 118, 120, 124, 134, 135, 138, 141, 148, 149, 197};

bool is_silent(int m) {
    return std::find(std::begin(kSilent), std::end(kSilent), m) != std::end(kSilent);
}

std::size_t place_of(std::string_view letters, std::string_view name) {
    return name.size() == 1 ? letters.find(name[0]) : std::string_view::npos;
}

// True for words that only some blocks have: the factor of M103, the distance of M120 and so on.
bool belongs_to_function(std::string_view name) {
    return name == "LA" || name == "LB" || name == "T" || name == "TM" || name == "E";
}

constexpr std::string_view kFeeds[] = {"F", "FAUTO", "AUTO", "MAX", "FU", "FZ"};

// True for words that are read elsewhere or mean nothing here.
bool is_passed(const Item& item, std::string_view own) {
    // The normal of the surface: radius compensation alone uses it.
    const bool is_normal = own == "LN" && item.value && item.name.size() == 2 && item.name[0] == 'N';
    // Old controls print the words that a block leaves empty.
    const bool is_empty = (item.name == "R" || item.name == "M") && !item.value && item.sign == 0;
    return is_normal || is_empty || std::ranges::find(kFeeds, item.name) != std::end(kFeeds);
}

// M128 F1000, M103 F20, M140 MB50 F750: the feed of the rotary axes, a share of the feed, and the feed of the
// retraction; not that of the path.
bool is_of_function(const std::vector<Item>& items, std::size_t i) {
    if (items[i].name != "F") return false;
    std::size_t at = i;
    while (at > 0 && (items[at - 1].name.starts_with("MB") || items[at - 1].name == "MAX")) --at;
    if (at == 0 || items[at - 1].name != "M" || !items[at - 1].value) return false;
    const double m = *items[at - 1].value;
    return m == 140 || (at == i && (m == 128 || m == 103));
}

}  // namespace

// Sorts the items of a path function; `own` is its name, for messages. Words of free contours go to `free`.
Result<Interpreter::Words> Interpreter::read_words(LineReader& in, std::string_view own, FreeWords* free) {
    Words words;
    words.first_column = in.column();
    if (auto done = all_items(in, words.items); !done) return std::unexpected(done.error());
    for (std::size_t i = 0; i < words.items.size(); ++i) {
        if (free != nullptr) {
            const auto taken = free_word(in, words.items, i, *free);
            if (!taken) return std::unexpected(taken.error());
            if (*taken) continue;
        }
        if (auto done = sort_word(in, words.items[i], own, words); !done)
            return std::unexpected(done.error());
    }
    for (std::size_t i = 0; i + 1 < words.items.size(); ++i) {
        const Item &item = words.items[i], &next = words.items[i + 1];
        if (next.name != "MAX" || item.value || is_of_function(words.items, i)) continue;
        if (item.name == "F") words.fast = true;
        if (item.name == "MB") words.retract = std::numeric_limits<double>::infinity();
    }
    for (const int m : words.m) words.machine_position = words.machine_position || m == 91 || m == 92;
    return words;
}

Result<void> Interpreter::sort_word(LineReader& in, const Item& item, std::string_view own, Words& words) {
    std::string_view name = item.name;
    // LIN_Z of a circle: it rises on its way.
    if (name.starts_with("LIN_") && own.starts_with('C')) name.remove_prefix(4);
    const bool incremental = name.size() >= 2 && name[0] == 'I';
    if (incremental) name.remove_prefix(1);
    const std::size_t axis = place_of(kAxes, name), rotary = place_of(kRotary, name);
    const bool is_bare_axis = rotary != std::string_view::npos && !item.value;  // M138 A C, M116 B
    const std::size_t vector =
        item.name.size() == 2 && item.name[0] == 'T' ? kAxes.find(item.name[1]) : std::string_view::npos;
    if (axis < 3 && item.value) {
        const int k = static_cast<int>(axis);
        double mm = *item.value * unit_mm_;
        if (auto good = in.in_range(kLimits.coordinate, mm, item.column); !good) return good;
        if (!incremental) mm += (mm - scale_centre_mm_[k]) * (scale_[k] - 1);
        mm *= (incremental ? scale_[k] : 1) * mirror_[k];
        (incremental ? words.increment : words.axis)[axis] = mm;
    } else if (const std::size_t parallel = place_of(kParallel, name);
               parallel < 3 && item.value && own == "L") {
        const double from_mm = incremental ? path_.parallel_mm(static_cast<int>(parallel)) : 0;
        words.parallel[parallel] = from_mm + *item.value * unit_mm_;
    } else if (rotary < 3 && item.value) {
        if (auto good = in.in_range(kLimits.rotary_angle, *item.value, item.column); !good) return good;
        (incremental ? words.turn : words.rotary)[rotary] = item.value;
    } else if (vector < 3 && item.value && own == "LN") {
        words.vector[vector] = *item.value * mirror_[static_cast<int>(vector)];
    } else if (is_passed(item, own) ||
               (!words.m.empty() && (belongs_to_function(item.name) || is_bare_axis))) {
        return {};
    } else if (name == "PR" && item.value) {
        words.polar_radius = *item.value * unit_mm_;
        words.polar_radius_increment = incremental;
    } else if (name == "PA" && item.value) {
        (incremental ? words.polar_turn : words.polar_angle) = item.value;
    } else if (item.name == "DR" && item.sign != 0) {
        words.direction = item.sign;
    } else if (item.value && ((item.name == "LEN" && (own == "APPR" || own == "DEP")) ||
                              (own == "CHF" && item.name.empty() && !words.length))) {
        words.length = *item.value * unit_mm_ * plane_scale();
    } else if (item.name == "CCA" && item.value && (own == "APPR" || own == "DEP")) {
        words.angle = item.value;
    } else if (item.name == "R" && item.value && !words.radius &&
               (own == "CR" || own == "RND" || own == "APPR" || own == "DEP")) {
        words.radius = *item.value * unit_mm_ * plane_scale();
    } else if (item.name == "R" && item.value == 0.0) {
        words.side = 0;
    } else if (item.name == "RL" || item.name == "RR") {
        words.side = item.name == "RL" ? 1 : -1;
    } else if (item.name == "R" && !item.value && item.sign != 0) {
        if (path_.first(kOneAxisCompensation)) {
            path_.warn(
                item.line,
                "R+ and R- lengthen and shorten a move along one axis by the tool's radius: the programmed "
                "path is taken");
        }
    } else if (item.name == "R") {
        return in.refuse(item.column, "R with a number is no radius compensation", "write RL, RR or R0");
    } else if (item.name == "FMAX") {
        words.fast = true;
    } else if (item.name == "FT" || item.name == "FMAXT") {
        if (path_.first(kTimedFeed)) {
            path_.warn(item.line, item.name + " gives the time of a move: the feed before it stays");
        }
    } else if (item.name == "M" && item.value) {
        if (*item.value < 0 || *item.value > 999 || *item.value != std::floor(*item.value)) {
            return in.refuse(item.column, "M without a whole number", "correct it");
        }
        words.m.push_back(static_cast<int>(*item.value));
    } else if (item.name == "MB") {
        if (item.value) words.retract = *item.value * unit_mm_;
    } else if (item.name == "MBMAX") {
        words.retract = std::numeric_limits<double>::infinity();
    } else {
        return in.refuse(item.column,
                         "'" + item.name + "' does not belong into " +
                             (own == "M" ? "this block" : "a block " + std::string(own)),
                         "correct or delete it");
    }
    return {};
}

Result<void> Interpreter::apply_feed(const Words& words) {
    for (std::size_t i = 0; i < words.items.size(); ++i) {
        const Item& item = words.items[i];
        if (is_of_function(words.items, i)) continue;
        const bool automatic =
            item.name == "FAUTO" || (item.name == "F" && !item.value && i + 1 < words.items.size() &&
                                     words.items[i + 1].name == "AUTO");
        if (automatic) {
            if (!(tool_feed_ > 0)) {
                return path_.refuse(place(item.column), "F AUTO without a feed in TOOL CALL",
                                    "write F there");
            }
            path_.feed_mm_per_min = tool_feed_;
        } else if ((item.name == "F" || item.name == "FU" || item.name == "FZ") && item.value) {
            const auto feed = feed_of(item);
            if (!feed) return std::unexpected(feed.error());
            path_.feed_mm_per_min = *feed;
        }
    }
    return {};
}

// The feed of F, FU (per turn) or FZ (per tooth), mm/min.
Result<double> Interpreter::feed_of(const Item& item) {
    const bool per_tooth = item.name == "FZ";
    const bool is_per_minute = !per_tooth && item.name != "FU" && !feed_per_turn_;
    double feed = *item.value * (is_per_minute ? feed_unit_mm() : unit_mm_);
    if (!is_per_minute) {
        const int teeth = per_tooth ? path_.flutes() : 1;
        if (!(path_.spindle_rpm > 0) || teeth == 0) {
            if (path_.options.default_feed_mm_per_min > 0) {
                path_.warn(line_.number,
                           "a feed per turn or per tooth without a speed or without the "
                           "number of teeth: the job's feed is taken");
                return path_.options.default_feed_mm_per_min;
            }
            return path_.refuse(place(item.column),
                                per_tooth ? "FZ without a speed, or without the number of teeth"
                                          : "a feed per turn without a speed",
                                "write S in TOOL CALL and F in mm/min");
        }
        feed *= path_.spindle_rpm * teeth;
    }
    if (auto good = path_.in_range(kLimits.feed, feed, place(item.column)); !good)
        return std::unexpected(good.error());
    return feed;
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
                end_program();
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
            case 116:
            case 117:
                path_.feed_on_part = m == 116;
                break;
            case 126:
            case 127:
                shortest_way_ = m == 126;
                break;
            case 128:
            case 129:
                if (auto done = close_contour(); !done) return done;
                if (m == 128 && !path_.machine) {
                    path_.note_machine_needed(line_.number, "tool tip control (M128)");
                }
                path_.switch_tip_control(m == 128, line_.number);
                break;
            case 130:
                if (path_.frame.is_tilted()) {
                    return path_.refuse(place(words.first_column),
                                        "M130 moves in coordinates before the plane was tilted",
                                        "write PLANE RESET before it");
                }
                break;
            case 136:
            case 137:
                feed_per_turn_ = m == 136;
                break;
            case 140:
                if (auto done = retract(words); !done) return done;
                break;
            default:
                if (is_silent(m)) break;
                if (auto done = pass_over("M" + std::to_string(m)); !done) return done;
        }
    }
    if (!call) return {};
    cycle_at_every_position_ = false;
    return run_cycle(place(words.first_column));
}

// M140 MB 50 and M140 MB MAX: back along the tool, by a length or to the end of the travel.
Result<void> Interpreter::retract(const Words& words) {
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    if (!words.retract || !std::isfinite(*words.retract) || !path_.knows_tip() || path_.machine) {
        if (path_.frame.is_tilted() || path_.machine || path_.axis() != Vec3{0, 0, 1}) {
            path_.lose(line_.number);
        } else {
            path_.put(path_.tip(), {path_.known(0), path_.known(1), Known::lost}, line_.number);
        }
        return {};
    }
    const Vec3 to = path_.tip() + *words.retract * path_.frame.direction_from_stock(path_.axis());
    const auto before = path_.feed_mm_per_min;
    for (std::size_t i = 0; i < words.items.size(); ++i) {
        if (!words.items[i].value || !is_of_function(words.items, i)) continue;
        const auto feed = feed_of(words.items[i]);
        if (!feed) return std::unexpected(feed.error());
        path_.feed_mm_per_min = *feed;
    }
    auto done = go(!path_.feed_mm_per_min || words.fast, to, {}, path_.rotary_rad());
    path_.feed_mm_per_min = before;
    return done;
}

}  // namespace tribo::readers::heidenhain
