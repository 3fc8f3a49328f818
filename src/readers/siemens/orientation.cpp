// SPDX-License-Identifier: MIT
// The tool's axis and the rotary axes.
#include <cmath>

#include "base/math.hpp"
#include "readers/siemens/interpreter.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr std::string_view kRotary = "ABC";

}  // namespace

// Finds the axis of the tool and the angles of the rotary axes at the end of the block.
Result<void> Interpreter::orient(const Words& words) {
    target_rad_ = path_.rotary_rad();
    turns_ = false;
    if (words.has_rotary()) {
        const auto to = rotary_target(words);
        if (!to) return std::unexpected(to.error());
        target_rad_ = *to;
        turns_ = target_rad_ != path_.rotary_rad();
        return {};
    }
    if (!words.has_vector() && !words.has_angle()) return {};
    Vec3 axis;
    if (words.has_vector()) {
        for (int k = 0; k < 3; ++k)
            axis[k] = words.vector[static_cast<std::size_t>(k)].value_or(0) * scale_[k];
    } else {
        if (!euler_stated_ && path_.first(kEulerAngles)) {
            path_.warn(line_number(), "A2 B2 C2 without ORIEULER or ORIRPY are taken as Euler angles");
        }
        double rad[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const double deg = words.angle[k].value_or(0);
            if (auto good = path_.in_range(kLimits.rotary_angle, deg, place(words.first_column)); !good)
                return good;
            rad[k] = deg * math::kRadPerDeg;
        }
        motion::WorkFrame turned;
        if (euler_) {
            turned = turned.turned({0, 0, 1}, rad[0]).turned({1, 0, 0}, rad[1]).turned({0, 0, 1}, rad[2]);
        } else {
            turned = turned.turned({0, 0, 1}, rad[2]).turned({0, 1, 0}, rad[1]).turned({1, 0, 0}, rad[0]);
        }
        axis = turned.z;
    }
    if (!(length(axis) > 1e-6) || !(length(axis) < 1e9)) {
        return path_.refuse(place(words.first_column), "the tool's axis has no direction",
                            "write A3 B3 C3 as the direction from the tip to the shank");
    }
    axis = normalized(path_.frame.direction_in_stock(axis));
    if (path_.machine) {
        const auto reached = path_.machine->kinematics().joints({{}, axis}, {{}, target_rad_});
        if (!reached) {
            return path_.refuse(
                place(words.first_column),
                "the machine " + path_.machine->machine().name + " cannot turn its tool there",
                "name the machine that the program is written for");
        }
        target_rad_ = reached->joints.rotary_rad;
        turns_ = target_rad_ != path_.rotary_rad();
    } else {
        turns_ = axis != path_.axis();
    }
    path_.aim(axis);
    return {};
}

// A, B and C; DC() goes the shorter way, ACP() and ACN() go in one direction.
Result<Vec3> Interpreter::rotary_target(const Words& words) {
    Vec3 to = path_.rotary_rad();
    for (int k = 0; k < 3; ++k) {
        const auto& word = words.rotary[static_cast<std::size_t>(k)];
        if (!word) continue;
        if (auto good = path_.in_range(kLimits.rotary_angle, word->value, place(word->column)); !good)
            return std::unexpected(good.error());
        const double rad = word->value * math::kRadPerDeg;
        const std::string letter(1, kRotary[static_cast<std::size_t>(k)]);
        if (path_.machine && path_.rolled() && path_.rolled()->rotary == k) {
            return path_.refuse(place(word->column), letter + " is turned by TRACYL",
                                "write its coordinate in the plane, or TRAFOOF before it");
        }
        const bool adds =
            word->measure == Measure::incremental || (word->measure == Measure::modal && incremental_);
        if (!path_.machine) {
            // At zero there is nothing to turn; what turns needs the machine.
            if (rad == 0 && !path_.program.has_rotary_words) continue;
            path_.note_machine_needed(line_number(), "rotary axes (A B C) mean nothing");
            continue;
        }
        if (!path_.machine->has_axis(kRotary[static_cast<std::size_t>(k)])) {
            return path_.refuse(place(word->column),
                                "the machine " + path_.machine->machine().name + " has no axis " + letter,
                                "name the machine that the program is written for");
        }
        const double from = to[k];
        to[k] = rad + (adds ? from : 0);
        if (word->measure == Measure::shortest) {
            to[k] += math::kTwoPi * std::floor((from - to[k]) / math::kTwoPi + 0.5);
        } else if (word->measure == Measure::positive) {
            to[k] += math::kTwoPi * std::ceil((from - to[k]) / math::kTwoPi - 1e-12);
        } else if (word->measure == Measure::negative) {
            to[k] += math::kTwoPi * std::floor((from - to[k]) / math::kTwoPi + 1e-12);
        }
    }
    return to;
}

// TRAORI and TRAFOOF. Each transformation ends the one before it.
Result<void> Interpreter::switch_tip_control(bool on) {
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    path_.unroll();
    path_.switch_tip_control(on, line_number());
    return {};
}

// TRACYL(d, n, k): the plane X Y is rolled about the rotary axis of the table. TRANSMIT: X and Y lie in the
// part, as if nothing turned it; how the machine shares the way between X and C does not change the tip.
// Sinumerik 840D, Job Planning: Transformations.
Result<void> Interpreter::transform_kinematics(const Words& words) {
    if (auto done = switch_tip_control(false); !done) return done;
    if (words.is_polar) {
        path_.switch_tip_control(true, line_number());
        if (path_.first(kPolar)) {
            path_.warn(line_number(),
                       "TRANSMIT: X and Y are taken as those of the part; how X and C share the way, and "
                       "whether C is fast enough near the centre, is not computed");
        }
        return {};
    }
    const Call& call = *words.cylinder;
    const Place where{call.line, call.column};
    const double radius_mm = call.at(0) / 2 * unit_mm_;
    if (!(radius_mm > 0))
        return path_.refuse(where, "TRACYL without the diameter of its cylinder", "write TRACYL(40)");
    if (auto good = path_.in_range(kLimits.coordinate, radius_mm, where); !good) return good;
    if (call.at(2) != 0) {
        return path_.refuse(where, "TRACYL with an offset of the groove's wall is not read",
                            "write the path of the tool's centre, and TRACYL with its diameter alone");
    }
    if (path_.frame.is_tilted())
        return path_.refuse(where, "TRACYL in a tilted plane", "end CYCLE800 before it");
    if (!path_.machine) {
        if (!path_.program.has_rotary_words) path_.program.first_rotary_line = line_number();
        path_.program.has_rotary_words = true;
        if (passed_over_.insert("TRACYL").second)
            path_.warn(line_number(), "TRACYL without a machine: its plane is taken as flat");
    }
    if (path_.roll(radius_mm, line_number())) return {};
    return path_.refuse(where,
                        "the machine " + path_.machine->machine().name +
                            " has no table that turns about X or Y, as TRACYL needs it",
                        "name the machine that the program is written for");
}

}  // namespace tribo::readers::siemens
