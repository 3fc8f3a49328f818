// SPDX-License-Identifier: MIT
// The paths of the drilling, tapping and bore milling cycles. TNC 640 manual, Programming of Machining
// Cycles.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/heidenhain/interpreter.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr double kChipBreakMm = 0.2;
constexpr int kMostInfeeds = 100'000;
constexpr double kSpotAngleDeg = 90;

// Cycle 1: distance above the last depth at which the feed begins again.
double advance_mm(double depth) {
    return depth <= 30 ? 0.6 : std::min(depth / 50, 7.0);
}

}  // namespace

Result<void> Interpreter::go_to_height(double z, double feed_mm_per_min) {
    Vec3 to = path_.tip();
    to.z = z;
    const bool rapid = !(feed_mm_per_min < kFastFeed);
    const auto before = path_.feed_mm_per_min;
    if (!rapid) path_.feed_mm_per_min = feed_mm_per_min;
    auto done = go(rapid, to, {}, path_.rotary_rad());
    path_.feed_mm_per_min = before;
    return done;
}

Result<void> Interpreter::go_to_place(double x, double y, double feed_mm_per_min) {
    const Vec3 to{x, y, path_.tip().z};
    const bool rapid = !(feed_mm_per_min < kFastFeed);
    const auto before = path_.feed_mm_per_min;
    if (!rapid) path_.feed_mm_per_min = feed_mm_per_min;
    auto done = go(rapid, to, {}, path_.rotary_rad());
    path_.feed_mm_per_min = before;
    return done;
}

// From the depth to the clearance, and on to the second one.
Result<void> Interpreter::return_from(double surface, double feed_mm_per_min) {
    const double clearance = surface + cycle_.at(200), second = surface + cycle_.at(204);
    if (auto done = path_.dwell(std::max(cycle_.at(211), 0.0), cycle_.place); !done) return done;
    if (auto done = go_to_height(clearance, feed_mm_per_min); !done) return done;
    return second > clearance ? go_to_height(second, kRapid) : Result<void>{};
}

// 200 and 203: drills infeed by infeed; between infeeds returns to the set-up clearance, or by a short
// distance to break the chip.
Result<void> Interpreter::drill() {
    const double surface = cycle_.at(203), clearance = surface + cycle_.at(200);
    const double depth = -cycle_.at(201);
    const bool universal = cycle_.number == 203;
    const double plunge = cycle_.at(206);
    double retract = universal ? cycle_.at(208) : kRapid;
    if (universal && retract == 0) retract = plunge;
    double infeed = cycle_.at(202) > 0 ? cycle_.at(202) : depth;
    const double least = std::max(cycle_.at(205), 1e-3), chip = cycle_.at(256, kChipBreakMm);
    const int breaks = universal ? static_cast<int>(std::clamp(cycle_.at(213), 0.0, 1e6)) : 0;
    if (auto done = go_to_height(clearance, kRapid); !done) return done;
    double reached = 0;
    for (int i = 0, broken = 0; reached < depth; ++i) {
        if (i > kMostInfeeds)
            return path_.refuse(cycle_.place, "the cycle has too many infeeds", "correct Q202");
        reached = std::min(depth, reached + infeed);
        if (auto done = go_to_height(surface - reached, plunge); !done) return done;
        if (reached >= depth) break;
        if (broken < breaks) {
            ++broken;
            if (auto done = go_to_height(surface - reached + chip, retract); !done) return done;
        } else {
            broken = 0;
            if (auto done = go_to_height(clearance, retract); !done) return done;
            if (auto done = path_.dwell(std::max(cycle_.at(210), 0.0), cycle_.place); !done) {
                return done;
            }
            const double back = std::min(clearance, surface - reached + cycle_.at(200));
            if (auto done = go_to_height(back, kRapid); !done) return done;
        }
        if (universal) infeed = std::max(infeed - std::max(cycle_.at(212), 0.0), least);
    }
    return return_from(surface, retract);
}

// 205: pecks, with chips broken between them, and returns to just above the last depth.
Result<void> Interpreter::peck_deep() {
    const double surface = cycle_.at(203), depth = -cycle_.at(201), plunge = cycle_.at(206);
    const double clearance = surface + cycle_.at(200), chip = cycle_.at(256, kChipBreakMm);
    const double least = std::max(cycle_.at(205), 1e-3), breaks = cycle_.at(257);
    double infeed = cycle_.at(202) > 0 ? cycle_.at(202) : depth;
    double reached = std::clamp(cycle_.at(379), 0.0, depth);
    if (auto done = go_to_height(clearance, kRapid); !done) return done;
    if (reached > 0) {
        const double to_start = cycle_.at(253) > 0 ? cycle_.at(253) : plunge;
        if (auto done = go_to_height(surface - reached, to_start); !done) return done;
    }
    int steps = 0;
    while (reached < depth) {
        const double next = std::min(depth, reached + infeed);
        while (reached < next) {
            if (++steps > kMostInfeeds)
                return path_.refuse(cycle_.place, "the cycle has too many infeeds", "correct Q202");
            reached = breaks > 0 ? std::min(next, reached + breaks) : next;
            if (auto done = go_to_height(surface - reached, plunge); !done) return done;
            if (reached >= next) break;
            if (auto done = go_to_height(surface - reached + chip, plunge); !done) return done;
        }
        if (reached >= depth) break;
        if (auto done = go_to_height(clearance, kRapid); !done) return done;
        const double back = surface - reached + std::max(cycle_.at(258, kChipBreakMm), 0.0);
        if (auto done = go_to_height(std::min(clearance, back), kRapid); !done) return done;
        infeed = std::max(infeed - std::max(cycle_.at(212), 0.0), least);
    }
    return return_from(surface, cycle_.at(208) > 0 ? cycle_.at(208) : kRapid);
}

// 201, 202, 240 and 241: to the depth in one move; the first two return at their own feed, and 241 turns
// slower outside of its drilling (Q427, Q428).
Result<void> Interpreter::bore() {
    const double surface = cycle_.at(203), plunge = cycle_.at(206), rpm = path_.spindle_rpm;
    const bool has_speeds = cycle_.number == 241;
    const double entry_rpm = has_speeds && cycle_.at(427) > 0 ? cycle_.at(427) : rpm;
    const double drill_rpm = has_speeds && cycle_.at(428) > 0 ? cycle_.at(428) : rpm;
    for (const double speed : {entry_rpm, drill_rpm}) {
        if (auto good = path_.in_range(kLimits.spindle_speed, speed, cycle_.place); !good) return good;
    }
    double depth = -cycle_.at(201);
    if (cycle_.number == 240 && cycle_.at(343) != 0) {
        depth = std::abs(cycle_.at(344)) / 2 / math::tan(kSpotAngleDeg / 2 * math::kRadPerDeg);
        if (path_.first(kSpotAngle)) {
            path_.warn(cycle_.place.line, "cycle 240 centres to a diameter: a point of 90 degrees is taken");
        }
    }
    if (cycle_.number == 202 && cycle_.at(214) != 0 && path_.first(kDisengage)) {
        path_.warn(cycle_.place.line,
                   "cycle 202 steps off the wall before it retracts (Q214): that step is left out");
    }
    if (auto done = go_to_height(surface + cycle_.at(200), kRapid); !done) return done;
    path_.spindle_rpm = entry_rpm;
    if (has_speeds && cycle_.at(379) > 0) {
        const double to_start = cycle_.at(253) > 0 ? cycle_.at(253) : plunge;
        const double start = std::min(cycle_.at(379), depth);
        if (auto done = go_to_height(surface - start, to_start); !done) return done;
    }
    path_.spindle_rpm = drill_rpm;
    if (auto done = go_to_height(surface - depth, plunge); !done) return done;
    path_.spindle_rpm = entry_rpm;
    const double slow = cycle_.at(208) > 0 ? cycle_.at(208) : plunge;
    auto done = return_from(surface, cycle_.number == 240 ? kRapid : slow);
    path_.spindle_rpm = rpm;
    return done;
}

Result<void> Interpreter::check_back_boring(const Cycle& cycle) const {
    if (!(cycle.at(249) > 0) || !(cycle.at(250) > 0) || cycle.at(251) < 0 || cycle.at(252) < 0 ||
        cycle.at(200) < 0) {
        return path_.refuse(cycle.place, "Q200, Q249, Q250, Q251 or Q252 of cycle 204 is out of range",
                            "write the depth of the counterbore and the thickness above 0, the others not "
                            "below it");
    }
    const double direction = cycle.at(214);
    if (direction != 1 && direction != 2 && direction != 3 && direction != 4) {
        return path_.refuse(cycle.place, "cycle 204 has no direction to step aside",
                            "write 1 (-X), 2 (-Y), 3 (+X) or 4 (+Y) for Q214");
    }
    for (const int feed : {253, 254}) {
        if (cycle.at(feed) == kRapid || (feed == 253 && !(cycle.at(feed) > 0))) continue;
        if (auto good = path_.in_range(kLimits.feed, cycle.at(feed), cycle.place); !good) return good;
    }
    return {};
}

// 204: through the hole aside of its middle with a spindle that stands, then upwards into the underside. The
// length of the bar is that of its lower end, which lies Q252 below the edge.
Result<void> Interpreter::bore_back() {
    const double surface = cycle_.at(203), clearance = surface + cycle_.at(200);
    const double underside = surface - cycle_.at(250) - cycle_.at(252);
    const double positioning = cycle_feed(253).value_or(kRapid);
    const int direction = static_cast<int>(cycle_.at(214));
    const double way = direction <= 2 ? -cycle_.at(251) : cycle_.at(251);
    const Vec3 middle = path_.tip();
    const Vec3 aside = middle + (direction % 2 == 1 ? Vec3{way, 0, 0} : Vec3{0, way, 0});
    if (path_.first(kBackBoring)) {
        path_.warn(
            cycle_.place.line,
            "cycle 204 leads a boring bar through its hole aside of the middle, with a spindle that "
            "stands: the cutter counts as turning, with edges all along, and mills the hole wider, unless "
            "the job gives it a profile");
    }
    if (auto done = go_to_height(clearance, kRapid); !done) return done;
    if (auto done = go_to_place(aside.x, aside.y, positioning); !done) return done;
    if (auto done = go_to_height(underside - cycle_.at(200), positioning); !done) return done;
    if (auto done = go_to_place(middle.x, middle.y, positioning); !done) return done;
    if (auto done = go_to_height(underside + cycle_.at(249), cycle_.at(254)); !done) return done;
    if (auto done = path_.dwell(std::max(cycle_.at(255), 0.0), cycle_.place); !done) return done;
    if (auto done = go_to_height(underside - cycle_.at(200), positioning); !done) return done;
    if (auto done = go_to_place(aside.x, aside.y, positioning); !done) return done;
    if (auto done = go_to_height(clearance, positioning); !done) return done;
    if (auto done = go_to_place(middle.x, middle.y, positioning); !done) return done;
    const double second = surface + cycle_.at(204);
    return second > clearance ? go_to_height(second, kRapid) : Result<void>{};
}

// 206, 207 and 209: the thread's pitch and the speed make the feed; down and up again.
Result<void> Interpreter::tap() {
    const double surface = cycle_.at(203), depth = -cycle_.at(201);
    double feed = cycle_.at(206);
    if (cycle_.number != 206) {
        feed = std::abs(cycle_.at(239)) * path_.spindle_rpm;
        if (!(feed > 0)) {
            return path_.refuse(cycle_.place, "a thread without a speed S or a pitch Q239",
                                "write S in TOOL CALL and the pitch");
        }
        if (auto good = path_.in_range(kLimits.feed, feed, cycle_.place); !good) return good;
    }
    if (auto done = go_to_height(surface + cycle_.at(200), kRapid); !done) return done;
    const double breaks = cycle_.number == 209 ? cycle_.at(257) : 0;
    int steps = 0;
    for (double reached = breaks > 0 ? breaks : depth; reached < depth; reached += breaks) {
        if (++steps > kMostInfeeds)
            return path_.refuse(cycle_.place, "the cycle has too many infeeds", "correct Q257");
        if (auto done = go_to_height(surface - reached, feed); !done) return done;
        const double back =
            cycle_.at(256) > 0 ? surface - reached + cycle_.at(256) : surface + cycle_.at(200);
        if (auto done = go_to_height(back, feed); !done) return done;
    }
    if (auto done = go_to_height(surface - depth, feed); !done) return done;
    return return_from(surface, feed);
}

// The tool's radius with DR, for cycles that need it; `room` is the radius of the narrowest place, mm.
double Interpreter::cutter_radius(double room) {
    return path_.clearing_radius_mm(unit_mm_, cycle_.place.line, room) + tool_oversize_mm_;
}

// 208: a helix to the depth, a full circle there, and back to the middle. The way to the wall is half a
// circle. A bore of more than twice the tool's diameter is meant to be drilled before, to Q342; while that is
// 0, the control checks the two diameters and refuses the cycle.
Result<void> Interpreter::mill_bore() {
    const double radius = cutter_radius(cycle_.at(335) / 2);
    const double orbit = cycle_.at(335) / 2 - radius;
    if (!(orbit > 1e-3)) {
        return path_.refuse(cycle_.place, "the tool is not smaller than the bore Q335",
                            "take a smaller tool or cycle 200");
    }
    const double core = cycle_.at(335) - 4 * radius, drilled = cycle_.at(342);
    if (core > std::max(drilled, 0.0) + 1e-3 && passed_over_.insert("Q342").second) {
        path_.warn(cycle_.place.line,
                   "cycle 208 leaves a core of " + short_decimal(core) +
                       " mm in the middle of the bore, which is wider than twice the tool" +
                       (drilled > 0 ? ": Q342 says that " + short_decimal(drilled) + " mm are drilled before"
                                    : "; the control refuses that while Q342 is 0") +
                       ". Take a larger tool, or drill before and write the diameter in Q342");
    }
    const double surface = cycle_.at(203), bottom = surface + cycle_.at(201);
    const double clearance = surface + cycle_.at(200), direction = cycle_.at(351) < 0 ? -1 : 1;
    const Vec3 middle = path_.tip();
    if (auto done = go_to_height(clearance, kRapid); !done) return done;
    const auto before = path_.feed_mm_per_min;
    if (cycle_.at(206) < kFastFeed) path_.feed_mm_per_min = cycle_.at(206);
    const auto turn = [&](double centre_x, double z, double rad, Vec3 to) {
        motion::Arc arc;
        arc.centre_mm = {centre_x, middle.y, z};
        arc.normal = {0, 0, direction};
        arc.turn_rad = rad;
        return go(false, to, arc, path_.rotary_rad());
    };
    const double turns = (clearance - bottom) / cycle_.at(334);
    if (!(turns < kMostInfeeds)) {
        return path_.refuse(cycle_.place, "the cycle has too many infeeds", "correct Q334");
    }
    const double whole = direction * math::kTwoPi * turns;
    const Vec3 end{middle.x + orbit * math::cos(whole), middle.y + orbit * math::sin(whole), bottom};
    auto done = turn(middle.x + orbit / 2, clearance, math::kPi, {middle.x + orbit, middle.y, clearance});
    if (done) done = turn(middle.x, clearance, math::kTwoPi * turns, end);
    if (done) done = turn(middle.x, bottom, math::kTwoPi, end);
    path_.feed_mm_per_min = before;
    if (!done) return done;
    if (done = go_to_place(middle.x, middle.y, cycle_.at(206)); !done) return done;
    return return_from(surface, kRapid);
}

// Cycles 1, 2 and 17: from where the tool stands, which is the clearance .1 above the surface.
Result<void> Interpreter::drill_as_of_old() {
    const double start = path_.tip().z, surface = start - std::abs(cycle_.at(1));
    const double depth = std::abs(cycle_.at(2));
    const bool pecks = cycle_.number == 1;
    double feed = pecks ? cycle_.at(5) : cycle_.at(4);
    if (cycle_.number == 17) feed = std::abs(cycle_.at(3)) * path_.spindle_rpm;
    const double infeed = pecks && cycle_.at(3) != 0 ? std::abs(cycle_.at(3)) : depth;
    if (!(depth > 0) || !(feed > 0)) {
        return path_.refuse(cycle_.place,
                            "cycle " + std::to_string(cycle_.number) + " lacks its depth or feed",
                            "write all lines of the cycle, and S in TOOL CALL");
    }
    if (auto good = path_.in_range(kLimits.feed, feed, cycle_.place); !good) return good;
    int steps = 0;
    for (double reached = 0; reached < depth;) {
        if (++steps > kMostInfeeds)
            return path_.refuse(cycle_.place, "the cycle has too many infeeds", "correct its infeed");
        reached = std::min(depth, reached + infeed);
        if (auto done = go_to_height(surface - reached, feed); !done) return done;
        if (reached >= depth) break;
        if (auto done = go_to_height(start, kRapid); !done) return done;
        const double back = surface - reached + advance_mm(depth);
        if (auto done = go_to_height(std::min(start, back), kRapid); !done) return done;
    }
    const double dwell = cycle_.number == 17 ? 0 : cycle_.at(pecks ? 4 : 3);
    if (auto done = path_.dwell(std::max(dwell, 0.0), cycle_.place); !done) return done;
    return go_to_height(start, pecks ? kRapid : feed);
}

}  // namespace tribo::readers::heidenhain
