// SPDX-License-Identifier: MIT
// Threads that are milled: cycles 262 to 265 and 267. TNC 430 manual, Cycles for Drilling, Tapping and Thread
// Milling. The ways to the thread and from it are half circles.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/heidenhain/interpreter.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr double kMostTurns = 10'000;
constexpr double kLeastOrbitMm = 1e-3;

}  // namespace

bool Interpreter::is_thread(int number) {
    return (number >= 262 && number <= 265) || number == 267;
}

// The feed of a cycle's parameter; none: a rapid.
std::optional<double> Interpreter::cycle_feed(int parameter) const {
    const double feed = cycle_.at(parameter);
    return feed > 0 && feed < kFastFeed ? std::optional(feed) : std::nullopt;
}

// What the words of the cycle in force say, but for the heights. A right-hand thread that turns to the left
// goes up. Climbing turns to the left in a hole, to the right about a bolt.
Result<control::Helix> Interpreter::thread_of_cycle() {
    control::Helix helix;
    helix.is_outside = cycle_.number == 267;
    const double radius = cutter_radius(helix.is_outside ? control::kOpenMm : cycle_.at(335) / 2);
    helix.radius = cycle_.at(335) / 2 + (helix.is_outside ? radius : -radius);
    helix.lead = helix.is_outside ? std::max(radius, helix.radius / 2) : helix.radius / 2;
    helix.centre = path_.tip();
    helix.feed = cycle_.at(207);
    helix.plunge = cycle_feed(253);
    helix.way = (cycle_.at(351) < 0) == helix.is_outside ? 1 : -1;
    if (cycle_.number == 265) helix.way = cycle_.at(239) > 0 ? -1 : 1;  // on its way down
    if (!(helix.radius > kLeastOrbitMm)) {
        return path_.refuse(cycle_.place, "the tool is not smaller than the thread Q335",
                            "take a smaller tool");
    }
    if (auto good = path_.in_range(kLimits.feed, helix.feed, cycle_.place); !good)
        return std::unexpected(good.error());
    const double pitch = std::abs(cycle_.at(239)), depth = -cycle_.at(201);
    if (!(pitch > 0) || !(depth > 0) || !(depth / pitch <= kMostTurns)) {
        return path_.refuse(cycle_.place, "the thread has no pitch Q239, or no depth Q201",
                            "write the pitch, and the depth with a minus sign");
    }
    return helix;
}

Result<void> Interpreter::mill_thread() {
    auto helix = thread_of_cycle();
    if (!helix) return std::unexpected(helix.error());
    if (path_.first(kThreadWay)) {
        path_.warn(cycle_.place.line, "the ways to and from the thread of cycle " +
                                          std::to_string(cycle_.number) +
                                          " are the control's own: half circles are taken");
    }
    const double surface = cycle_.at(203), clearance = surface + cycle_.at(200);
    auto done = go_to_height(clearance, kRapid);
    if (done && cycle_.number == 263) done = sink_to_depth(surface + cycle_.at(356));
    if (done && cycle_.number == 264) done = drill_before_thread();
    const bool sinks_first = cycle_.number != 262 && !(cycle_.number == 265 && cycle_.at(360) != 0);
    if (done && sinks_first) done = sink_front(*helix);
    if (done) done = mill_turns(*helix);
    if (done && cycle_.number == 265 && cycle_.at(360) != 0) done = sink_front(*helix);
    return done ? return_from(surface, kRapid) : done;
}

// The turns of the thread. Q355: 0: one at the bottom, for a tool with as many teeth as the thread is deep;
// 1: from end to end; above: one turn after each so many pitches.
Result<void> Interpreter::mill_turns(control::Helix helix) {
    const double surface = cycle_.at(203), bottom = surface + cycle_.at(201);
    const double pitch = std::abs(cycle_.at(239));
    const bool is_whole =
        cycle_.number == 265 || (cycle_.number != 263 && cycle_.number != 264 && cycle_.at(355) == 1);
    const double steps = cycle_.number == 262 || cycle_.number == 267 ? std::floor(cycle_.at(355)) : 0;
    const bool goes_up = (cycle_.at(239) > 0) == (helix.way > 0);
    const double height = is_whole ? surface - bottom : pitch;
    const double count = is_whole || steps < 1 ? 1 : std::ceil((surface - bottom) / (steps * pitch) - 1e-9);
    helix.turns = height / pitch;
    for (double i = 0; i < count; ++i) {
        const double low = bottom + (goes_up ? i : count - 1 - i) * steps * pitch;
        helix.from_z = goes_up ? low : low + height;
        helix.to_z = goes_up ? low + height : low;
        const auto end = control::mill_helix(helix, path_.tip(), mover());
        if (!end) return std::unexpected(end.error());
    }
    return {};
}

// 263: the hole is countersunk with the tool's shank, down to a height.
Result<void> Interpreter::sink_to_depth(double z) {
    if (auto done = go_to_height(z + cycle_.at(200), cycle_feed(253).value_or(kRapid)); !done) return done;
    return go_to_height(z, cycle_.at(254));
}

// 264: the hole is drilled to Q356 first.
Result<void> Interpreter::drill_before_thread() {
    const Cycle thread = cycle_;
    cycle_.q[201] = thread.at(356);
    cycle_.q[204] = 0;
    auto done = peck_deep();
    cycle_ = thread;
    return done;
}

// The face of the hole or bolt is countersunk by a circle whose radius is Q359, at the height Q358.
Result<void> Interpreter::sink_front(control::Helix circle) {
    if (cycle_.at(358) == 0 && cycle_.at(359) == 0) return {};
    const double z = cycle_.at(203) + cycle_.at(358);
    const auto feed = cycle_feed(254);
    if (!feed) {
        return path_.refuse(cycle_.place, "countersinking without its feed Q254", "write Q254");
    }
    if (cycle_.at(359) == 0) return sink_to_depth(z);
    circle.radius = std::abs(cycle_.at(359));
    circle.lead = circle.is_outside ? circle.lead : circle.radius / 2;
    circle.turns = 1;
    circle.from_z = circle.to_z = z;
    circle.feed = *feed;
    const auto end = control::mill_helix(circle, path_.tip(), mover());
    return end ? Result<void>{} : std::unexpected(end.error());
}

}  // namespace tribo::readers::heidenhain
