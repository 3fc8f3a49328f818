// SPDX-License-Identifier: MIT
// Pockets, slots and studs whose ways the control finds itself: cycles 4, 5, 210 to 215, 251 to 254, 256 to
// 258. Rings are taken, with a warning. TNC 640 manual, Programming of Machining Cycles; TNC 426 manual.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/control/pocket.hpp"
#include "readers/heidenhain/interpreter.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr double kMostRings = 10'000;
constexpr double kFits = -1e-6;
constexpr int kMostSides = 1000;

// 210 to 215, of the TNC 426: 212 to 215 finish the edge alone.
bool is_of_tnc_426(int number) {
    return number >= 210 && number <= 215;
}
bool is_slot(int number) {
    return number == 3 || number == 210 || number == 253;
}
bool is_curved(int number) {
    return number == 211 || number == 254;
}
bool is_stud(int number) {
    return number == 213 || number == 215 || (number >= 256 && number <= 258);
}

}  // namespace

bool Interpreter::is_pocket(int number) {
    return (number >= 3 && number <= 5) || is_of_tnc_426(number) || (number >= 251 && number <= 254) ||
           (number >= 256 && number <= 258);
}

// CYCL DEF 4.3 PECKG 5 F80: a length, and a feed or a direction behind it.
Result<void> Interpreter::define_old_pocket(LineReader& in, int part) {
    std::vector<Item> items;
    if (auto done = all_items(in, items); !done) return done;
    for (const Item& item : items) {
        if (item.name == "DR") {
            cycle_.q[kTurn] = item.sign;
        } else if (cycle_.number == 3 && part == 4 && item.name == "Y" && item.value) {
            cycle_.q[kAlongY] = 1;
            cycle_.q[part] = *item.value * unit_mm_;
        } else if (item.name == "F" && item.value) {
            cycle_.q[kFeedOfPart + part] = *item.value * feed_unit_mm();
        } else if (item.value) {
            cycle_.q[part] = *item.value * unit_mm_;
        }
    }
    return {};
}

// What the words of the cycle in force say.
Result<control::Pocket> Interpreter::pocket_of_cycle() {
    const int number = cycle_.number;
    const bool is_old = number < 200;
    control::Pocket pocket;
    const double surface = is_old ? path_.tip().z - std::abs(cycle_.at(1)) : cycle_.at(203);
    const double near = surface + (is_old ? std::abs(cycle_.at(1)) : cycle_.at(200));
    const double depth = -std::abs(is_old ? cycle_.at(2) : cycle_.at(201));
    pocket.depths = {std::max(near, surface + cycle_.at(204)), surface, near, surface + depth};
    pocket.infeed = std::abs(is_old ? cycle_.at(3) : cycle_.at(202));
    pocket.plunge = is_old ? cycle_.at(kFeedOfPart + 3) : cycle_.at(206);
    pocket.feed = is_old ? cycle_.at(kFeedOfPart + (number == 5 ? 5 : 6)) : cycle_.at(207);
    pocket.clockwise = is_old ? cycle_.at(kTurn) < 0 : cycle_.at(351) < 0;
    if (is_stud(number)) pocket.clockwise = !pocket.clockwise;  // climbing, outside
    pocket.centre = path_.tip();
    if (is_of_tnc_426(number) || (number == 254 && cycle_.at(367) == 0))
        pocket.centre = in_frame(cycle_.at(216), cycle_.at(217), pocket.centre.z);
    switch (number) {
        case 3:
            pocket.half_length = std::abs(cycle_.at(4)) / 2;
            pocket.half_width = pocket.corner = std::abs(cycle_.at(5)) / 2;
            pocket.angle_rad = cycle_.at(kAlongY) * math::kPi / 2;
            break;
        case 4:
            pocket.half_length = std::abs(cycle_.at(4)) / 2;
            pocket.half_width = std::abs(cycle_.at(5)) / 2;
            pocket.corner = std::abs(cycle_.at(6));
            break;
        case 5:
            pocket.half_length = pocket.half_width = pocket.corner = std::abs(cycle_.at(4));
            break;
        case 214:
        case 215:
        case 252:
        case 257:
            pocket.half_length = pocket.half_width = pocket.corner = std::abs(cycle_.at(223)) / 2;
            pocket.blank_half_length = pocket.blank_half_width = std::abs(cycle_.at(222)) / 2;
            break;
        case 258:
            if (auto done = read_polygon(pocket); !done) return std::unexpected(done.error());
            break;
        case 211:
        case 254:
            pocket.half_length = pocket.half_width = pocket.corner = std::abs(cycle_.at(219)) / 2;
            pocket.angle_rad = cycle_.at(number == 211 ? 245 : 376) * math::kRadPerDeg;
            break;
        default:
            pocket.half_length = std::abs(cycle_.at(218)) / 2;
            pocket.half_width = std::abs(cycle_.at(219)) / 2;
            pocket.corner = is_slot(number) ? pocket.half_width : std::abs(cycle_.at(220));
            pocket.blank_half_length = std::abs(cycle_.at(424)) / 2;
            pocket.blank_half_width = std::abs(cycle_.at(425)) / 2;
            if (number == 213) {
                pocket.blank_half_length = pocket.half_length + std::abs(cycle_.at(221));
                pocket.blank_half_width = pocket.half_width + std::abs(cycle_.at(221));
            }
            pocket.angle_rad = cycle_.at(number == 253 ? 374 : 224) * math::kRadPerDeg;
            break;
    }
    if (!is_old && cycle_.at(215) == 1) {  // roughing alone
        pocket.allowance = std::abs(cycle_.at(368));
        pocket.depths.bottom += std::abs(cycle_.at(369));
    }
    pocket.along_edge = (number >= 212 && number <= 215) || (!is_old && cycle_.at(215) == 2);
    for (double* feed : {&pocket.plunge, &pocket.feed}) {
        if (!(*feed > 0)) *feed = path_.feed_mm_per_min.value_or(0);
        *feed = std::min(*feed, kFastFeed);
        if (auto good = path_.in_range(kLimits.feed, *feed, cycle_.place); !good)
            return std::unexpected(good.error());
    }
    return pocket;
}

// 258: Q573 says whether the circle Q571 lies within the sides, or about the corners.
Result<void> Interpreter::read_polygon(control::Pocket& stud) const {
    const double sides = cycle_.at(572);
    if (!(sides >= 3) || !(sides <= kMostSides) || sides != std::floor(sides)) {
        return path_.refuse(cycle_.place, "cycle 258 has no number of corners from 3 to 1000",
                            "correct Q572");
    }
    if (cycle_.at(220) < 0) {
        return path_.refuse(cycle_.place, "chamfered corners of cycle 258 are not read",
                            "write a radius for Q220, or 0");
    }
    const double radius = std::abs(cycle_.at(571)) / 2;
    stud.half_width = cycle_.at(573) == 1 ? radius * math::cos(math::kPi / sides) : radius;
    stud.half_length = stud.half_width;
    stud.corner = cycle_.at(220);
    stud.blank_half_length = stud.blank_half_width = std::abs(cycle_.at(222)) / 2;
    stud.angle_rad = cycle_.at(224) * math::kRadPerDeg;
    return {};
}

// Q367: where the tool stands at the call. 0: in the middle; of a pocket 1 to 4: in a corner, from the lower
// left one on; of a slot 1 to 4: at its left end, in the centre of that end's circle, and so on to the right.
Vec3 Interpreter::middle_of(const control::Pocket& pocket) const {
    const int place = static_cast<int>(std::clamp(cycle_.at(367), 0.0, 4.0));
    double x = 0, y = 0;
    if (is_slot(cycle_.number)) {
        const double to_end = pocket.half_length, to_circle = pocket.half_length - pocket.half_width;
        const double at[] = {0, to_end, to_circle, -to_circle, -to_end};
        x = at[place];
    } else if (place > 0 && (cycle_.number == 251 || cycle_.number == 256)) {
        x = place == 1 || place == 4 ? pocket.half_length : -pocket.half_length;
        y = place <= 2 ? pocket.half_width : -pocket.half_width;
    }
    const double c = math::cos(pocket.angle_rad), s = math::sin(pocket.angle_rad);
    return pocket.centre + Vec3{c * x - s * y, s * x + c * y, 0};
}

Result<void> Interpreter::mill_pocket_cycle() {
    const std::string name = "cycle " + std::to_string(cycle_.number);
    auto pocket = pocket_of_cycle();
    if (!pocket) return std::unexpected(pocket.error());
    const double radius = cutter_radius(
        is_stud(cycle_.number) ? control::kOpenMm : std::min(pocket->half_length, pocket->half_width));
    pocket->radius = radius;
    pocket->step = cycle_.number >= 200 ? std::abs(cycle_.at(370)) * radius : 0;
    pocket->centre = middle_of(*pocket);
    if (cycle_.number == 3) {  // the tool stands at an end of the slot; the sign of its length leads away
        const double to_middle = std::copysign(pocket->half_length - radius, cycle_.at(4));
        (cycle_.at(kAlongY) > 0 ? pocket->centre.y : pocket->centre.x) += to_middle;
    }
    const bool goes_round = is_stud(cycle_.number);
    const double most = std::min(pocket->half_length, pocket->half_width) - radius - pocket->allowance;
    if (!(pocket->half_width > 0) || !(pocket->half_length > 0) || (!goes_round && !(most >= kFits))) {
        return path_.refuse(cycle_.place, "the tool does not fit into the pocket of " + name,
                            "take a smaller tool, or correct its sides");
    }
    if (!(pocket->depths.bottom < pocket->depths.top)) {
        return path_.refuse(cycle_.place, name + " has no depth", "correct it");
    }
    if (path_.first(kPocketWay)) {
        path_.warn(cycle_.place.line, "the way of the tool within " + name +
                                          " is the control's own: rings are taken, straight down at their "
                                          "start");
    }
    const auto milled = [&](double rings, const auto& mill) -> Result<void> {
        if (rings <= kMostRings) return mill();
        return path_.refuse(cycle_.place, name + " needs more than 10000 rings", "take a larger infeed");
    };
    if (is_curved(cycle_.number)) return mill_curved_slots(*pocket);
    if (cycle_.number == 258) {
        const control::Polygon polygon{*pocket, static_cast<int>(cycle_.at(572))};
        return milled(control::ring_count(polygon),
                      [&] { return control::mill_polygon(polygon, path_.tip(), mover()); });
    }
    if (goes_round) {
        return milled(control::stud_ring_count(*pocket),
                      [&] { return control::mill_stud(*pocket, path_.tip(), mover()); });
    }
    return milled(control::ring_count(*pocket),
                  [&] { return control::mill_pocket(*pocket, path_.tip(), mover()); });
}

// 211 and 254: slots along an arc. Where the tool stands at an end or in the middle of the slot (Q367 1 to
// 3), the start angle leads there.
Result<void> Interpreter::mill_curved_slots(const control::Pocket& pocket) {
    const bool is_old = cycle_.number == 211;
    control::CurvedSlot slot;
    slot.pocket = pocket;
    slot.arc_radius = std::abs(cycle_.at(is_old ? 244 : 375)) / 2;
    slot.sweep_rad = std::abs(cycle_.at(248)) * math::kRadPerDeg;
    const double stands = is_old ? 0 : std::clamp(cycle_.at(367), 0.0, 3.0);
    if (stands > 0) {
        double sine = 0, cosine = 0;
        math::sincos(pocket.angle_rad, sine, cosine);
        slot.pocket.centre = path_.tip() - slot.arc_radius * Vec3{cosine, sine, 0};
        slot.pocket.angle_rad -= (stands - 1) / 2 * slot.sweep_rad;
    }
    const double count = is_old ? 1 : std::floor(cycle_.at(377, 1));
    const double rings = count * control::ring_count(slot);
    if (!(slot.arc_radius > pocket.half_width) || !(slot.sweep_rad > 0) ||
        !(slot.sweep_rad <= math::kTwoPi) || !(count >= 1) || !(rings <= kMostRings)) {
        return path_.refuse(cycle_.place,
                            "the slot of cycle " + std::to_string(cycle_.number) +
                                " is no arc, or needs more than 10000 rings",
                            "correct its width, circle, angle and number");
    }
    const double first_rad = slot.pocket.angle_rad;
    for (double i = 0; i < count; ++i) {
        slot.pocket.angle_rad = first_rad + i * cycle_.at(378) * math::kRadPerDeg;
        if (auto done = control::mill_slot(slot, path_.tip(), mover()); !done) return done;
    }
    return {};
}

// Moves of a cycle; no feed: a rapid.
control::PocketMove Interpreter::mover() {
    return [this](Vec3 to, std::optional<double> feed, const std::optional<motion::Arc>& arc) {
        const bool rapid = !feed || !(*feed < kFastFeed);
        const auto before = path_.feed_mm_per_min;
        if (!rapid) path_.feed_mm_per_min = feed;
        auto done = go(rapid, to, arc, path_.rotary_rad());
        path_.feed_mm_per_min = before;
        return done;
    };
}

}  // namespace tribo::readers::heidenhain
