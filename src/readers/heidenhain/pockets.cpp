// SPDX-License-Identifier: MIT
// Pockets, slots and studs whose ways the control finds itself: cycles 4, 5, 251, 252, 253, 256, 257. Rings
// are taken, with a warning. TNC 640 manual, Programming of Machining Cycles; TNC 426 manual.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/control/pocket.hpp"
#include "readers/heidenhain/interpreter.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr double kMostRings = 10'000;
constexpr double kFits = -1e-6;
constexpr double kFastFeed = 99'999;  // value of a feed for FMAX

}  // namespace

bool Interpreter::is_pocket(int number) {
    return number == 4 || number == 5 || number == 251 || number == 252 || number == 253 || number == 256 ||
           number == 257;
}

// CYCL DEF 4.3 PECKG 5 F80: a length, and a feed or a direction behind it.
Result<void> Interpreter::define_old_pocket(LineReader& in, int part) {
    std::vector<Item> items;
    if (auto done = all_items(in, items); !done) return done;
    for (const Item& item : items) {
        if (item.name == "DR") {
            cycle_.q[kTurn] = item.sign;
        } else if (item.name == "F" && item.value) {
            cycle_.q[kFeedOfPart + part] = *item.value * unit_mm_;
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
    pocket.feed = is_old ? cycle_.at(kFeedOfPart + (number == 4 ? 6 : 5)) : cycle_.at(207);
    pocket.clockwise = is_old ? cycle_.at(kTurn) < 0 : cycle_.at(351) < 0;
    if (number == 256 || number == 257) pocket.clockwise = !pocket.clockwise;  // climbing, outside
    pocket.centre = path_.tip();
    switch (number) {
        case 4:
            pocket.half_length = std::abs(cycle_.at(4)) / 2;
            pocket.half_width = std::abs(cycle_.at(5)) / 2;
            pocket.corner = std::abs(cycle_.at(6));
            break;
        case 5:
            pocket.half_length = pocket.half_width = pocket.corner = std::abs(cycle_.at(4));
            break;
        case 252:
        case 257:
            pocket.half_length = pocket.half_width = pocket.corner = std::abs(cycle_.at(223)) / 2;
            pocket.blank_half_length = pocket.blank_half_width = std::abs(cycle_.at(222)) / 2;
            break;
        default:
            pocket.half_length = std::abs(cycle_.at(218)) / 2;
            pocket.half_width = std::abs(cycle_.at(219)) / 2;
            pocket.corner = number == 253 ? pocket.half_width : std::abs(cycle_.at(220));
            pocket.blank_half_length = std::abs(cycle_.at(424)) / 2;
            pocket.blank_half_width = std::abs(cycle_.at(425)) / 2;
            pocket.angle_rad = cycle_.at(number == 253 ? 374 : 224) * math::kRadPerDeg;
            break;
    }
    if (!is_old && cycle_.at(215) == 1) {  // roughing alone
        pocket.allowance = std::abs(cycle_.at(368));
        pocket.depths.bottom += std::abs(cycle_.at(369));
    }
    pocket.along_edge = !is_old && cycle_.at(215) == 2;
    for (double* feed : {&pocket.plunge, &pocket.feed}) {
        if (!(*feed > 0)) *feed = path_.feed_mm_per_min.value_or(0);
        *feed = std::min(*feed, kFastFeed);
        if (auto good = path_.in_range(kLimits.feed, *feed, cycle_.place); !good)
            return std::unexpected(good.error());
    }
    return pocket;
}

// Q367: where the tool stands at the call. 0: in the middle; of a pocket 1 to 4: in a corner, from the lower
// left one on; of a slot 1 to 4: at its left end, in the centre of that end's circle, and so on to the right.
Vec3 Interpreter::middle_of(const control::Pocket& pocket) const {
    const int place = static_cast<int>(std::clamp(cycle_.at(367), 0.0, 4.0));
    double x = 0, y = 0;
    if (cycle_.number == 253) {
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
    const auto radius = cutter_radius(cycle_.place);
    if (!radius) return std::unexpected(radius.error());
    pocket->radius = *radius;
    pocket->step = cycle_.number >= 200 ? std::abs(cycle_.at(370)) * *radius : 0;
    pocket->centre = middle_of(*pocket);
    const bool is_stud = cycle_.number == 256 || cycle_.number == 257;
    const double most = std::min(pocket->half_length, pocket->half_width) - *radius - pocket->allowance;
    if (!(pocket->half_width > 0) || !(pocket->half_length > 0) || (!is_stud && !(most >= kFits))) {
        return path_.refuse(cycle_.place, "the tool does not fit into the pocket of " + name,
                            "take a smaller tool, or correct its sides");
    }
    if (!(pocket->depths.bottom < pocket->depths.top)) {
        return path_.refuse(cycle_.place, name + " has no depth", "correct it");
    }
    if ((is_stud ? control::stud_ring_count(*pocket) : control::ring_count(*pocket)) > kMostRings) {
        return path_.refuse(cycle_.place, name + " needs more than 10000 rings", "take a larger infeed");
    }
    if (path_.first(kPocketWay)) {
        path_.warn(cycle_.place.line, "the way of the tool within " + name +
                                          " is the control's own: rings are taken, straight down at their "
                                          "start");
    }
    const auto go_to = [&](Vec3 to, std::optional<double> feed, const std::optional<motion::Arc>& arc) {
        const auto before = path_.feed_mm_per_min;
        if (feed) path_.feed_mm_per_min = feed;
        auto done = go(!feed, to, arc, path_.rotary_rad());
        path_.feed_mm_per_min = before;
        return done;
    };
    return is_stud ? control::mill_stud(*pocket, path_.tip(), go_to)
                   : control::mill_pocket(*pocket, path_.tip(), go_to);
}

}  // namespace tribo::readers::heidenhain
