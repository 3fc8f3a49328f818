// SPDX-License-Identifier: MIT
// The drilling, tapping and boring cycles CYCLE81 to CYCLE89 and CYCLE840.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/siemens/interpreter.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr int kMostStrokes = 100'000;
constexpr double kLeastStrokeMm = 1e-3;
constexpr double kChipBreakMm = 1;
constexpr double kShankAngleDeg = 118;

// Coarse pitches of metric threads, mm.
constexpr std::pair<double, double> kPitches[] = {
    {2, 0.4},   {2.5, 0.45}, {3, 0.5}, {4, 0.7},  {5, 0.8},  {6, 1},    {8, 1.25}, {10, 1.5},
    {12, 1.75}, {14, 2},     {16, 2},  {18, 2.5}, {20, 2.5}, {22, 2.5}, {24, 3},   {27, 3},
    {30, 3.5},  {33, 3.5},   {36, 4},  {39, 4},   {42, 4.5}, {45, 4.5}, {48, 5},
};

// Distance above the last depth at which the feed begins again.
double advance_mm(double depth) {
    return depth <= 30 ? 0.6 : std::min(depth / 50, 7.0);
}

struct Layout {
    std::string_view name;
    std::size_t dwell, mode;  // places of DTB and _AMODE
};
constexpr std::size_t kNone = 99;
constexpr Layout kLayouts[] = {
    {"CYCLE81", kNone, 7}, {"CYCLE82", 5, 8},   {"CYCLE83", 8, 19}, {"CYCLE84", 5, 23},
    {"CYCLE85", 5, 10},    {"CYCLE86", 5, 13},  {"CYCLE88", 5, 99}, {"CYCLE87", kNone, 99},
    {"CYCLE89", 5, 8},     {"CYCLE840", 5, 19},
};

}  // namespace

// CYCLE8x(RTP, RFP, SDIS, DP, DPR, ...) at the place where the tool is.
Result<void> Interpreter::drill(const Call& call) {
    const Place where{call.line, call.column};
    const Layout& layout = *std::find_if(std::begin(kLayouts), std::end(kLayouts),
                                         [&](const Layout& known) { return known.name == call.name; });
    const int w = axes()[2];
    const Vec3 place_mm = path_.tip();
    const auto along = [&](double value) { return scale_[w] * value * unit_mm_; };
    const double top = along(call.at(1)), back = along(call.at(0));
    // _AMODE says which of both counts; without it DPR does where it is given.
    const int which = static_cast<int>(std::clamp(call.at(layout.mode), 0.0, 1e6)) % 10;
    const double increment = call.at(4) != 0 ? call.at(4) : call.at(3);
    const bool by_increment = which == 1 || (which == 0 && call.at(4) != 0);
    if (!by_increment && !call.has(3)) {
        return path_.refuse(where, call.name + " has no depth", "write DP, its depth, or DPR below RFP");
    }
    const double bottom = by_increment ? top - along(std::abs(increment)) : along(call.at(3));
    const double up = scale_[w] < 0 ? -1 : 1;  // along the tool
    const double near = top + up * std::abs(along(call.at(2))), depth = up * (top - bottom);
    for (const double z : {top, back, bottom, near}) {
        if (auto good = path_.in_range(kLimits.coordinate, z, where); !good) return good;
    }
    if (!(depth > 0) || up * (back - top) < 0) {
        return path_.refuse(where, call.name + ": the depth is not below RFP, or RTP is not above it",
                            "correct the cycle");
    }
    const auto to_height = [&](double z, std::optional<double> feed) -> Result<void> {
        Vec3 to = path_.tip();
        to[w] = z;
        const auto before = path_.feed_mm_per_min;
        if (feed) path_.feed_mm_per_min = *feed;
        auto done = go(!feed, to, {}, path_.rotary_rad());
        path_.feed_mm_per_min = before;
        return done;
    };
    const auto dwell = [&](double time) -> Result<void> {
        const double seconds = time >= 0 ? time : path_.spindle_rpm > 0 ? -time * 60 / path_.spindle_rpm : 0;
        return path_.dwell(seconds, where);
    };
    check_start(false);
    const double feed = path_.feed_mm_per_min.value_or(0);
    const bool taps = call.name == "CYCLE84" || call.name == "CYCLE840";
    if (!(feed > 0) && !taps && !(call.name == "CYCLE85" && call.at(6) > 0)) {
        return path_.refuse(where, call.name + " without a feed", "write F before it");
    }
    const double wait = call.at(layout.dwell);
    if (auto done = to_height(near, {}); !done) return done;

    // Drills to the depth in strokes: the first one, and what the ones behind it lose each.
    const auto strokes = [&](double first, double less, double least, auto between) -> Result<void> {
        double reached = 0, stroke = std::min(first, depth);
        for (int i = 0; reached < depth; ++i) {
            if (i > kMostStrokes)
                return path_.refuse(where, call.name + " has too many strokes", "correct it");
            reached = std::min(depth, reached + stroke);
            if (depth - reached < kLeastStrokeMm) reached = depth;
            if (auto done = between(reached, reached >= depth); !done) return done;
            const double left = depth - reached;
            if (less < 0) stroke *= -less;
            if (less > 0) stroke = std::max(stroke - less, less);
            stroke = std::max({stroke, least, kLeastStrokeMm});
            // The last two strokes are alike.
            if (less > 0 && stroke == less && left > less && left < 2 * less) stroke = left / 2;
        }
        return {};
    };
    if (call.name == "CYCLE83") {
        const double first = call.at(6) != 0 ? std::abs(along(call.at(6)))
                             : call.has(5)   ? up * (top - along(call.at(5)))
                                             : depth;
        if (!(first > 0)) {
            return path_.refuse(where, "CYCLE83: the first depth is not below RFP", "correct FDEP or FDPR");
        }
        const double less = call.at(7) > 0 ? std::abs(along(call.at(7))) : std::max(call.at(7), -1.0);
        const double slow = call.at(10) > 0 && call.at(10) <= 1 ? call.at(10) : 1;
        const bool clears = call.at(11) != 0;
        const double least = std::abs(along(call.at(13)));
        const double chip = call.at(14) > 0 ? std::abs(along(call.at(14))) : kChipBreakMm;
        const double ahead = call.at(16) > 0 ? std::abs(along(call.at(16))) : advance_mm(depth);
        double before = 0;
        auto done = strokes(first, less, least, [&](double reached, bool last) -> Result<void> {
            const double z = top - up * reached;
            if (auto moved = to_height(z, before == 0 ? feed * slow : feed); !moved) return moved;
            before = reached;
            if (auto waited = dwell(last && call.has(15) ? call.at(15) : wait); !waited || last)
                return waited;
            if (!clears) return to_height(z + up * chip, feed);
            if (auto moved = to_height(near, {}); !moved) return moved;
            if (auto waited = dwell(call.at(9)); !waited) return waited;
            return to_height(std::min(up * near, up * z + ahead) * up, {});
        });
        if (!done) return done;
        return to_height(back, {});
    }
    if (taps) {
        const bool rigid = call.name == "CYCLE84";
        const std::size_t size_at = rigid ? 7 : 9;
        double pitch = std::abs(call.at(size_at + 1)) * unit_mm_;
        const int unit = static_cast<int>(std::clamp(call.at(rigid ? 13 : 12), 0.0, 9.0));
        if (pitch > 0 && unit == 2) pitch = 25.4 / std::abs(call.at(size_at + 1));
        if (pitch > 0 && unit == 3) pitch = 25.4 * std::abs(call.at(size_at + 1));
        for (const auto& [size, coarse] : kPitches) {
            if (pitch == 0 && std::abs(call.at(size_at)) == size) pitch = coarse;
        }
        const double rpm = rigid && call.at(10) > 0 ? call.at(10) : path_.spindle_rpm;
        double down = pitch * rpm;
        if (!rigid && pitch == 0) down = feed;
        if (!(down > 0)) {
            return path_.refuse(where, call.name + " without a pitch or a speed", "write PIT, and SST or S");
        }
        const double out = rigid && call.at(11) > 0 ? pitch * call.at(11) : down;
        for (const double f : {down, out}) {
            if (auto good = path_.in_range(kLimits.feed, f, where); !good) return good;
        }
        const int way = rigid ? static_cast<int>(std::clamp(call.at(15), 0.0, 9.0)) % 10 : 0;
        const double peck = way != 0 && call.at(16) > 0 ? std::abs(along(call.at(16))) : depth;
        const double chip = call.at(17) > 0 ? std::abs(along(call.at(17))) : kChipBreakMm;
        const double modal_rpm = path_.spindle_rpm;
        path_.spindle_rpm = rpm;
        auto done = strokes(peck, 0, 0, [&](double reached, bool last) -> Result<void> {
            const double z = top - up * reached;
            if (auto moved = to_height(z, down); !moved || last) return moved;
            return to_height(way == 2 ? near : z + up * chip, out);
        });
        if (done) done = dwell(wait);
        if (done) done = to_height(near, out);
        path_.spindle_rpm = modal_rpm;
        if (!done) return done;
        return to_height(back, {});
    }
    double end = bottom;
    const int depth_kind =
        static_cast<int>(std::clamp(call.at(layout.mode < kNone ? layout.mode - 2 : kNone), 0.0, 1e6)) / 10 %
        10;
    if (depth_kind == 1 && call.name == "CYCLE82") {  // to the shank: the point goes deeper
        const auto radius = path_.tool_radius_mm(unit_mm_);
        const double point = radius ? *radius / math::tan(kShankAngleDeg / 2 * math::kRadPerDeg) : 0;
        end -= up * point;
        if (path_.first(kShank)) {
            path_.warn(line_number(),
                       "the depth of CYCLE82 is that of the shank: a point of 118 degrees is taken" +
                           std::string(radius ? "" : ", and none for a tool of unknown diameter"));
        }
    } else if (depth_kind == 1 && call.name == "CYCLE81") {
        return path_.refuse(where, "CYCLE81 by the diameter of the centre is not read", "write its depth");
    }
    const double down = call.name == "CYCLE85" && call.at(6) > 0 ? call.at(6) * unit_mm_ : feed;
    const double out = call.name == "CYCLE85" && call.at(7) > 0 ? call.at(7) * unit_mm_ : down;
    for (const double f : {down, out}) {
        if (auto good = path_.in_range(kLimits.feed, f, where); !good) return good;
    }
    if (auto done = to_height(end, down); !done) return done;
    if (auto done = dwell(wait); !done) return done;
    if (call.name == "CYCLE85" || call.name == "CYCLE89") {
        if (auto done = to_height(near, out); !done) return done;
    }
    if (call.name == "CYCLE86") {  // the spindle stops, and the edge leaves the wall
        const auto [u, v, n] = axes();
        Vec3 aside = path_.tip();
        aside[u] += scale_[u] * call.at(7) * unit_mm_;
        aside[v] += scale_[v] * call.at(8) * unit_mm_;
        aside[n] += along(call.at(9));
        for (int k = 0; k < 3; ++k) {
            if (auto good = path_.in_range(kLimits.coordinate, aside[k], where); !good) return good;
        }
        if (auto done = go(true, aside, {}, path_.rotary_rad()); !done) return done;
        if (auto done = to_height(back, {}); !done) return done;
        Vec3 over = path_.tip();
        over[u] = place_mm[u];
        over[v] = place_mm[v];
        return go(true, over, {}, path_.rotary_rad());
    }
    return to_height(back, {});
}

}  // namespace tribo::readers::siemens
