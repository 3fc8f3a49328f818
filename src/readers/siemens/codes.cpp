// SPDX-License-Identifier: MIT
// G and M codes, feeds, the spindle.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/siemens/interpreter.hpp"
#include "readers/text/decimal_text.hpp"
#include "readers/text/length_unit.hpp"

namespace tribo::readers::siemens {
namespace {

// Codes without effect on the path: exact stop, smoothing, corners of the compensation, feeds in corners,
// spindle modes, the ways to and from a contour that take no words.
constexpr int kSilentG[] = {9,   60,  62,  64,  97,  290, 340, 341, 450, 451, 460, 461, 462, 601, 602,
                            603, 621, 641, 642, 643, 644, 645, 971, 972, 973, 140, 141, 142, 143};
// Codes of other controls that move nothing.
constexpr int kForeignG[] = {43, 44, 49, 98, 99, 61};
// Stops, coolant, spindle positioning, gears.
constexpr int kSilentM[] = {0, 1, 5, 7, 8, 9, 10, 11, 19, 40, 41, 42, 43, 44, 45, 70};

struct Refused {
    int from, to;
    const char *what, *remedy;
};
constexpr Refused kRefusedG[] = {
    {5, 5, "grinding along an inclined axis", "only milling is read"},
    {7, 7, "grinding along an inclined axis", "only milling is read"},
    {33, 35, "threads of a lathe", "write G331, or a thread cycle"},
    {83, 89, "cycles of the Sinumerik 8xx", "write CYCLE83 to CYCLE89"},
    {147, 148, "ways to and from a contour", "write the way with G1 to G3"},
    {247, 248, "ways to and from a contour", "write the way with G1 to G3"},
    {291, 291, "the ISO language", "write the program in one language; read ISO with --dialect fanuc"},
    {347, 348, "ways to and from a contour", "write the way with G1 to G3"},
};

template <std::size_t N>
bool is_code_of(const int (&numbers)[N], int number) {
    return std::find(std::begin(numbers), std::end(numbers), number) != std::end(numbers);
}

}  // namespace

Result<void> Interpreter::apply_codes(Words& words) {
    const auto is_old_cycle = [](Code code) { return code.number == 81 || code.number == 82; };
    if (words.radius && (old_cycle_ != 0 || std::any_of(words.g.begin(), words.g.end(), is_old_cycle))) {
        variables_.set_r(2, *words.radius);
        words.radius.reset();
        if (path_.first(kReferencePlane)) {
            path_.warn(line_number(), "CR= beside G81 is taken for R2, the reference plane of the hole");
        }
    }
    if (words.motion && *words.motion != motion_) {
        if (auto done = close_spline(); !done) return done;
        motion_ = *words.motion;
    }
    for (const Code& code : words.g) {
        if (auto done = apply_g(words, code); !done) return done;
    }
    if (words.tool) {
        selected_tool_ = static_cast<int>(*words.tool);
        if (!changes_with_m6_) load_tool(selected_tool_);
    }
    apply_m_before(words);
    if (auto done = apply_spindle(words); !done) return done;
    if (words.tip_control) {
        if (auto done = switch_tip_control(*words.tip_control); !done) return done;
    }
    if (words.cylinder || words.is_polar) {
        if (auto done = transform_kinematics(words); !done) return done;
    }
    return apply_feed(words);
}

Result<void> Interpreter::apply_g(Words& words, const Code& code) {
    const int g = code.number;
    const auto choose_motion = [&](Motion motion) -> Result<void> {
        if (auto done = close_spline(); !done) return done;
        motion_ = motion;
        return {};
    };
    const auto choose_unit = [&](LengthUnit unit) -> Result<void> {
        unit_mm_ = mm_per(unit);
        has_unit_ = true;
        path_.rotary_feed.degree_mm = unit_mm_;
        return {};
    };
    switch (g) {
        case 0:
            return choose_motion(Motion::rapid);
        case 1:
        case 63:
            return choose_motion(Motion::line);
        case 331:
        case 332: {  // tapping: the pitch beside it, and the spindle's speed
            double pitch = 0;
            for (auto& word : words.centre) {
                if (word) pitch = std::abs(word->value) * unit_mm_;
                word.reset();
            }
            const double rpm = words.spindle ? words.spindle->value : path_.spindle_rpm;
            if (!(pitch > 0) || !(rpm > 0)) {
                return path_.refuse(place(code.column), "tapping without a pitch or a speed",
                                    "write for example G331 Z-20 K1.5 S300");
            }
            if (auto good = path_.in_range(kLimits.feed, pitch * rpm, place(code.column)); !good) return good;
            path_.feed_mm_per_min = pitch * rpm;
            path_.spindle_on = true;
            return choose_motion(Motion::line);
        }
        case 2:
            return choose_motion(Motion::clockwise);
        case 3:
            return choose_motion(Motion::counter_clockwise);
        case 4:
            return {};
        case 17:
        case 18:
        case 19: {
            const gcode::Plane plane = g == 17   ? gcode::Plane::xy
                                       : g == 18 ? gcode::Plane::zx
                                                 : gcode::Plane::yz;
            if (plane == plane_) return {};
            if (auto done = close_contour(); !done) return done;
            contour_.leave();
            plane_ = plane;
            return {};
        }
        case 20:
        case 21:
            if (path_.first(kUnitOfIso)) {
                path_.warn(
                    line_number(),
                    "G20 and G21 are words of the ISO mode of this control: they are read as G70 and G71");
            }
            return choose_unit(g == 20 ? LengthUnit::inch : LengthUnit::millimetre);
        case 70:
            if (path_.first(kFeedOfInches)) {
                path_.warn(
                    line_number(),
                    "G70: F is taken in inches per minute, as on a control that is set up in inches; one in "
                    "millimetres keeps mm/min: G700 and G710 leave no doubt");
            }
            return choose_unit(LengthUnit::inch);
        case 700:
            return choose_unit(LengthUnit::inch);
        case 71:
        case 710:
            return choose_unit(LengthUnit::millimetre);
        case 25:
        case 26:  // limits of the spindle or of the working area
            words.linear = {};
            words.rotary = {};
            words.spindle.reset();
            return {};
        case 40:
        case 41:
        case 42: {
            const int side = g == 40 ? 0 : g == 41 ? 1 : -1;
            if (side == side_) return {};
            if (side != 0 && is_spatial_) {
                if (path_.first(kSpatial)) {
                    path_.warn(line_number(),
                               "radius compensation in space (CUT3D) is not read: the "
                               "programmed path is taken");
                }
                return {};
            }
            if (auto done = close_contour(); !done) return done;
            side_ = side;
            return {};
        }
        case 80:
            modal_.reset();
            old_cycle_ = 0;
            return {};
        case 81:
        case 82:
            if (auto done = choose_motion(Motion::rapid); !done) return done;
            modal_.reset();
            old_cycle_ = g;
            return {};
        case 53:
        case 153:
            words.machine_place = true;
            return {};
        case 74:
        case 75:
            words.is_home = true;
            return {};
        case 90:
        case 91:
            incremental_ = g == 91;
            return {};
        case 93:
        case 94:
        case 95:
            if (feed_mode_ != g && !words.feed) path_.feed_mm_per_min.reset();
            feed_mode_ = g;
            return {};
        case 96:
        case 961:
        case 962:
            words.spindle.reset();
            if (path_.first(kSurfaceSpeed)) {
                path_.warn(line_number(), "G96 gives a surface speed of a lathe: the spindle's speed stays");
            }
            return {};
        case 110:
        case 111:
        case 112: {
            if (auto done = set_pole(words, g); !done) return done;
            words.linear = {};
            words.polar_angle.reset();
            words.polar_radius.reset();
            return {};
        }
        default:
            break;
    }
    // A work offset of the 802D; on the 840D a shift of the axes beside it, in a block of its own.
    const bool is_shift = (g == 58 || g == 59) && words.has_linear() && words.g.size() == 1;
    if (is_shift) {
        words.frame = g == 58 ? "G58" : "G59";
        return {};
    }
    if ((g >= 54 && g <= 59) || g == 500 || (g >= 505 && g <= 599)) {
        if (auto done = close_contour(); !done) return done;
        set_work_offset(g);
        return set_frame(line_number());
    }
    if (is_code_of(kSilentG, g) || (g >= 810 && g <= 829)) return {};
    const std::string name = "G" + std::to_string(g);
    if (is_code_of(kForeignG, g)) {
        if (passed_over_.insert(name).second) {
            path_.warn(line_number(), name + " is no code of this control: it is taken not to move the tool");
        }
        return {};
    }
    for (const Refused& refused : kRefusedG) {
        if (g < refused.from || g > refused.to) continue;
        return path_.refuse(place(code.column), name + " (" + refused.what + ") is not read", refused.remedy);
    }
    return path_.refuse(place(code.column), name + " is not known",
                        "correct it, or delete it where it does not move the tool");
}

// Functions that act before the move.
void Interpreter::apply_m_before(const Words& words) {
    for (const Code& code : words.m) {
        switch (code.number) {
            case 3:
            case 4:
            case 13:
            case 14:
                path_.spindle_on = true;
                break;
            case 6:
                load_tool(selected_tool_);
                break;
            default:
                break;
        }
    }
}

Result<void> Interpreter::apply_m_after(const Words& words) {
    for (const Code& code : words.m) {
        switch (code.number) {
            case 3:
            case 4:
            case 6:
            case 13:
            case 14:
                break;
            case 2:
            case 30:
                ended_ = true;
                break;
            case 17:
                (unit_ == &text_.main() ? ended_ : returned_) = true;
                break;
            case 5:
                path_.spindle_on = false;
                break;
            default: {
                if (is_code_of(kSilentM, code.number)) break;
                const std::string name = "M" + std::to_string(code.number);
                if (!passed_over_.insert(name).second) break;
                path_.warn(line_number(), name +
                                              " is not known: it is taken as a switch of the machine that "
                                              "moves nothing");
            }
        }
    }
    return {};
}

Result<void> Interpreter::apply_feed(const Words& words) {
    if (words.feed && std::none_of(words.g.begin(), words.g.end(), [](Code c) { return c.number == 4; })) {
        const Place where = place(words.feed->column);
        const double unit = feed_mode_ == 93 ? 1 : unit_mm_;
        feed_ = words.feed->value * unit;
        if (feed_ != 0) {
            const Limit& limit = feed_mode_ == 93   ? kLimits.inverse_time
                                 : feed_mode_ == 95 ? kLimits.feed_per_turn
                                                    : kLimits.feed;
            if (auto good = path_.in_range(limit, feed_, where); !good) return good;
        }
        if (feed_mode_ == 94) path_.feed_mm_per_min = feed_;
    }
    double per_turn = feed_mode_ == 95 ? feed_ : 0;
    Place where = place(words.first_column);
    if (words.tooth_feed) {
        where = place(words.tooth_feed->column);
        per_turn = words.tooth_feed->value * unit_mm_ * path_.flutes();
        if (!(per_turn > 0) && path_.options.default_feed_mm_per_min > 0) {
            path_.warn(line_number(), "FZ without the number of teeth: the job's feed is taken");
            path_.feed_mm_per_min = path_.options.default_feed_mm_per_min;
            return {};
        }
        if (!(per_turn > 0))
            return path_.refuse(where, "FZ without the number of teeth", "write F in mm/min");
    }
    if (!(per_turn > 0)) return {};
    if (!(path_.spindle_rpm > 0)) {
        if (!words.moves() || is_rapid(words)) return {};
        return path_.refuse(where, "a feed per turn without a speed", "write S before it");
    }
    const double feed = per_turn * path_.spindle_rpm;
    if (auto good = path_.in_range(kLimits.feed, feed, where); !good) return good;
    path_.feed_mm_per_min = feed;
    return {};
}

Result<void> Interpreter::apply_spindle(const Words& words) {
    if (!words.spindle) return {};
    if (std::any_of(words.g.begin(), words.g.end(), [](Code c) { return c.number == 4; })) return {};
    const double rpm = words.spindle->value;
    if (rpm != 0) {
        if (auto good = path_.in_range(kLimits.spindle_speed, rpm, place(words.spindle->column)); !good)
            return good;
    }
    path_.spindle_rpm = rpm;
    path_.spindle_stands = rpm == 0;
    return {};
}

// G4 F2: seconds; G4 S30: turns of the spindle.
Result<void> Interpreter::dwell(const Words& words) {
    const auto& given = words.feed ? words.feed : words.spindle;
    if (!given) {
        return path_.refuse(place(words.first_column), "G4 without F or S", "write the seconds as F");
    }
    double seconds = given->value;
    if (!words.feed) {
        if (!(path_.spindle_rpm > 0)) {
            return path_.refuse(place(given->column), "G4 S without a speed", "write the seconds as F");
        }
        seconds *= 60 / path_.spindle_rpm;
    }
    if (seconds != 0) {
        if (auto good = path_.in_range(kLimits.dwell, seconds, place(given->column)); !good) return good;
    }
    if (contour_.is_open() && side_ != 0) {
        if (path_.first(kDwellInContour)) {
            path_.warn(line_number(), "a dwell within radius compensation is left out");
        }
        return {};
    }
    if (auto done = close_contour(); !done) return done;
    return path_.dwell(seconds, place(given->column));
}

}  // namespace tribo::readers::siemens
