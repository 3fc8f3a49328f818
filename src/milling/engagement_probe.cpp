// SPDX-License-Identifier: MIT
#include "milling/engagement_probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.hpp"

namespace tribo::milling {
namespace {

// Where the stretches begin whose middles have the first circles of a part: near its ends, where what is
// engaged often changes, they are short.
constexpr std::array kFirstStretches{0.0, 0.05, 0.35, 0.65, 0.95, 1.0};
// Circles of one part at most.
constexpr std::size_t kMostLevels = 56;
// Splitting goes on until no circle may change the chips' area by more than this share, and what is smaller
// than this is not looked for, R^2.
constexpr double kAreaShare = 0.004, kLeastArea = 1e-4;
// How much of what is not seen between two circles without material may be material.
constexpr double kHidden = 0.05;
// Travel across the normal of less than this share is rounding.
constexpr double kOutward = 1e-7;
// Arcs that differ by less are one band on the cylinder, rad.
constexpr double kAlikeRad = 2e-3;

// Rotations at which `law` is above 0; from == to where nowhere.
struct Window {
    double from = 0, to = 0;
};
Window outward(const TurnLaw& law, double least) {
    const double slope = math::hypot(law.sine, law.cosine), base = law.constant - least;
    if (!(slope + base > 0)) return {};
    if (base >= slope) return {0, math::kTwoPi};
    const double border = math::asin(-base / slope);
    const double from = border - math::atan2(law.cosine, law.sine);
    const double start = from - math::kTwoPi * std::floor(from / math::kTwoPi);
    return {start, start + math::kPi - 2 * border};
}

// Integral of the law over the rotation.
double integral(const TurnLaw& law, double from, double to) {
    double sin0, cos0, sin1, cos1;
    math::sincos(from, sin0, cos0);
    math::sincos(to, sin1, cos1);
    return law.sine * (cos0 - cos1) + law.cosine * (sin1 - sin0) + law.constant * (to - from);
}

double fastest(const TurnLaw& law) {
    return math::hypot(law.sine, law.cosine) + law.constant;
}

}  // namespace

EngagementProbe::EngagementProbe(const Cutter& cutter)
    : profile_(cutter),
      radius_mm_(cutter.radius_mm()),
      core_mm_(0.5 * cutter.core_mm),
      length_mm_(cutter.length_mm) {
    levels_.reserve(kMostLevels + 2);
    arcs_.reserve(4 * kMostLevels);
    clear_.reserve(256);
}

bool EngagementProbe::clip_heights(const field::CarvedView& stock, const CutPose& pose, double& low,
                                   double& high) const {
    const Box3 blank = stock.field().blank().bounds_mm();
    low = 0;
    high = length_mm_;
    for (int axis = 0; axis < 3; ++axis) {
        const double u = pose.frame.z[axis];
        const double reach = radius_mm_ * std::sqrt(std::max(0.0, 1 - u * u));
        const double from = blank.min[axis] - reach - pose.tip_mm[axis];
        const double to = blank.max[axis] + reach - pose.tip_mm[axis];
        if (std::abs(u) < 1e-12) {
            if (from > 0 || to < 0) return false;
            continue;
        }
        low = std::max(low, std::min(from / u, to / u));
        high = std::min(high, std::max(from / u, to / u));
    }
    return high > low;
}

EngagementProbe::Level EngagementProbe::look(double s0, double s1, const field::CarvedView& stock,
                                             const CutPose& pose) {
    Level level;
    level.s0 = s0;
    level.s1 = s1;
    level.at = profile_.at(level.s());
    level.first = arcs_.size();
    const ToolTravel& t = pose.travel;
    const double way =
        t.across_mm + std::abs(t.down_mm) + length_mm_ * (std::abs(t.turn_x_rad) + std::abs(t.turn_y_rad));
    const TurnLaw law = normal_travel(t, level.at);
    const Window window = outward(law, kOutward * way);
    level.window_from = window.from;
    level.window_to = window.to;
    level.speed = std::max(0.0, fastest(law));
    if (!(window.to > window.from)) {
        level.gap_mm = math::kTwoPi * radius_mm_;
        level.speed = 0;
        return level;
    }
    const double r = level.at.radius_mm;
    const AxisCircle circle{pose.tip_mm + level.at.height_mm * pose.frame.z, r * pose.frame.x,
                            r * pose.frame.y, r};
    material_arcs(stock, circle, window.from, window.to, arcs_, clear_);
    level.seen_mm = s1 - s0;
    level.gap_mm = math::kTwoPi * radius_mm_;
    for (const ClearPiece& piece : clear_) {
        level.gap_mm = std::min(level.gap_mm, piece.clear_mm);
        double sine, cosine;
        math::sincos(piece.middle_rad, sine, cosine);
        const double flow = r * piece.size_rad * (law.sine * sine + law.cosine * cosine + law.constant);
        double within = 0.5 * level.seen_mm;
        for (double& sum : level.hidden) {
            if (piece.clear_mm < within) sum += flow;
            within /= 3;
        }
    }
    level.count = arcs_.size() - level.first;
    for (std::size_t n = level.first; n < arcs_.size(); ++n) {
        level.width_rad += arcs_[n].to_rad - arcs_[n].from_rad;
        level.flow += r * integral(law, arcs_[n].from_rad, arcs_[n].to_rad);
    }
    return level;
}

void EngagementProbe::start(double s0, double s1, const field::CarvedView& stock, const CutPose& pose) {
    for (std::size_t n = 0; n + 1 < kFirstStretches.size(); ++n) {
        levels_.push_back(
            look(s0 + (s1 - s0) * kFirstStretches[n], s0 + (s1 - s0) * kFirstStretches[n + 1], stock, pose));
    }
}

// What a level without material may not see of what is half as far as `apart_mm`.
double EngagementProbe::hidden(const Level& level, double apart_mm) const {
    const double third = level.seen_mm / 3;
    return level.hidden[apart_mm > 1.01 * third ? 0 : apart_mm > 1.01 * third / 3 ? 1 : 2];
}

// What the area that the chips sweep may be off by between two circles.
double EngagementProbe::error_between(const Level& a, const Level& b) const {
    // Of the difference between the two, where the same arcs go on, where one begins and where one ends.
    constexpr double kBend = 0.06, kBegin = 0.3, kEnd = 0.3;
    const double apart = b.s() - a.s(), radius = std::max(a.at.radius_mm, b.at.radius_mm);
    const double speed = std::max(a.speed, b.speed);
    if (a.count == 0 && b.count == 0) return kHidden * apart * std::max(hidden(a, apart), hidden(b, apart));
    const double change = std::abs(a.flow - b.flow);
    if (a.count == 0 || b.count == 0) return kEnd * (apart - std::max(a.gap_mm, b.gap_mm)) * change;
    if (a.count != b.count) {
        constexpr double kAnotherArc = 0.1;  // rad
        return kBegin * apart * (change + kAnotherArc * radius * speed);
    }
    constexpr double kStep = 0.5;  // rad
    const double jump = std::abs(a.width_rad - b.width_rad);
    return (jump < kStep ? kBend : kEnd) * apart * change;
}

double EngagementProbe::judge() {
    double area = 0;
    for (Level& level : levels_) {
        level.error = 0;
        area += (level.s1 - level.s0) * level.flow;
    }
    for (std::size_t n = 0; n + 1 < levels_.size(); ++n) {
        Level &a = levels_[n], &b = levels_[n + 1];
        const double error = error_between(a, b);
        Level& larger = a.s1 - a.s0 >= b.s1 - b.s0 ? a : b;
        larger.error = std::max(larger.error, error);
    }
    // The ends of the part, which have a neighbour on one side only.
    for (Level* end : {&levels_.front(), &levels_.back()}) {
        if (end->count == 0)
            end->error =
                std::max(end->error, kHidden * (end->s1 - end->s0) * hidden(*end, end->s1 - end->s0));
    }
    return area;
}

void EngagementProbe::refine(const field::CarvedView& stock, const CutPose& pose) {
    double speed = 0;
    for (const Level& level : levels_) speed = std::max(speed, level.speed);
    const double least = kLeastArea * radius_mm_ * radius_mm_ * speed;
    while (levels_.size() < kMostLevels) {
        const double most = std::max(kAreaShare * judge(), least);
        const auto worst = std::max_element(levels_.begin(), levels_.end(),
                                            [](const Level& a, const Level& b) { return a.error < b.error; });
        if (worst == levels_.end() || worst->error <= most) return;
        // In thirds: the one in the middle keeps its circle.
        const double s0 = worst->s0, s1 = worst->s1, third = (s1 - s0) / 3;
        worst->s0 = s0 + third;
        worst->s1 = s1 - third;
        const auto at = worst - levels_.begin();
        levels_.insert(levels_.begin() + at, look(s0, s0 + third, stock, pose));
        levels_.insert(levels_.begin() + at + 2, look(s1 - third, s1, stock, pose));
    }
}

// Nearer to the window's end an arc ends there, rad.
constexpr double kSide = 0.01;
bool EngagementProbe::starts_with_window(const Level& level, const MaterialArc& arc) const {
    return arc.from_rad - level.window_from < kSide;
}
bool EngagementProbe::ends_with_window(const Level& level, const MaterialArc& arc) const {
    return level.window_to - arc.to_rad < kSide;
}

// The last arc of a contact that gets narrower towards `end`, which is how far it may reach. Where two smooth
// surfaces part, the square of the width falls evenly.
MaterialArc EngagementProbe::closing_arc(const Level& level, const Level& inner, double end,
                                         std::size_t number) const {
    MaterialArc arc = arcs_[level.first + number];
    const MaterialArc& before = arcs_[inner.first + number];
    const double width = arc.to_rad - arc.from_rad, wider = before.to_rad - before.from_rad;
    // A fall of less than that is as good as none.
    constexpr double kLevelRad = 1e-4;
    if (!(width < wider - kLevelRad)) return arc;
    const double fall = (wider * wider - width * width) / std::abs(level.s() - inner.s());  // per mm
    const double half = 0.5 * (level.s1 - level.s0);
    // Wider than that it ends at a step, somewhere between. What lies beyond the stretch is counted as far as
    // the stretch is long: the arc stands for no more.
    const double closed = width * width / fall;
    const double reach = closed < std::abs(end - level.s()) ? std::min(closed, 3 * half) : half;
    const auto cubed = [&](double way) {  // of the width at that way towards the end
        const double square = std::max(width * width - fall * way, 0.0);
        return square * std::sqrt(square);
    };
    const double mean = std::min((cubed(-half) - cubed(reach)) / (1.5 * fall * 2 * half), wider);
    if (starts_with_window(level, arc) && !ends_with_window(level, arc))
        return {arc.from_rad, arc.from_rad + mean};
    if (ends_with_window(level, arc) && !starts_with_window(level, arc))
        return {arc.to_rad - mean, arc.to_rad};
    const double middle = 0.5 * (arc.from_rad + arc.to_rad);
    return {middle - 0.5 * mean, middle + 0.5 * mean};
}

MaterialArc EngagementProbe::mean_arc(std::size_t index, std::size_t number) const {
    const Level& level = levels_[index];
    const MaterialArc& arc = arcs_[level.first + number];
    const Level* below = index > 0 ? &levels_[index - 1] : nullptr;
    const Level* above = index + 1 < levels_.size() ? &levels_[index + 1] : nullptr;
    const auto alike = [&](const Level* other) { return other && other->count == level.count; };
    const auto none = [](const Level* other) { return !other || other->count == 0; };
    if (alike(below) && none(above)) return closing_arc(level, *below, above ? above->s() : level.s1, number);
    if (alike(above) && none(below)) return closing_arc(level, *above, below ? below->s() : level.s0, number);
    if (!alike(below) || !alike(above)) return arc;
    const MaterialArc &a = arcs_[below->first + number], &b = arcs_[above->first + number];
    const double from_below = level.s() - below->s(), to_above = above->s() - level.s();
    const double size = level.s1 - level.s0, share = size * size / (12 * (from_below + to_above));
    // Between rotations that may lie whole turns apart.
    const auto step = [](double from, double to) {
        return to - from - math::kTwoPi * std::floor((to - from) / math::kTwoPi + 0.5);
    };
    const auto mean = [&](double low, double middle, double high) {
        return middle + share * (step(middle, high) / to_above - step(low, middle) / from_below);
    };
    return {mean(a.from_rad, arc.from_rad, b.from_rad), mean(a.to_rad, arc.to_rad, b.to_rad)};
}

// Adds what the levels found. Where an arc ends with the window it goes on as far as the window does
// somewhere on the level's stretch: the force knows where each edge moves outward.
void EngagementProbe::add_bands(const CutPose& pose, Engagement& out) const {
    const std::size_t before = out.bands.size();
    for (std::size_t index = 0; index < levels_.size(); ++index) {
        const Level& level = levels_[index];
        if (level.count == 0) continue;
        Window wide{level.window_from, level.window_to};
        for (const double s : {level.s0, level.s1}) {
            const Window w = outward(normal_travel(pose.travel, profile_.at(s)), 0);
            if (!(w.to > w.from)) continue;
            const double turn = math::kTwoPi * std::floor((w.from - wide.from) / math::kTwoPi + 0.5);
            wide.from = std::min(wide.from, w.from - turn);
            wide.to = std::max(wide.to, w.to - turn);
        }
        if (wide.to - wide.from > math::kTwoPi) wide = {wide.from, wide.from + math::kTwoPi};
        for (std::size_t n = 0; n < level.count; ++n) {
            const MaterialArc &seen = arcs_[level.first + n], mean = mean_arc(index, n);
            const MaterialArc arc{starts_with_window(level, seen) ? wide.from : mean.from_rad,
                                  ends_with_window(level, seen) ? wide.to : mean.to_rad};
            const auto add = [&](double from, double to) {
                from = std::max(from, 0.0);
                to = std::min(to, math::kTwoPi);
                if (!(to > from)) return;
                if (level.s() < profile_.bottom_end()) {
                    out.bottom.push_back({level.s0, level.s1, from, to});
                    return;
                }
                const double z0 = profile_.at(level.s0).height_mm, z1 = profile_.at(level.s1).height_mm;
                for (std::size_t m = out.bands.size(); m > before; --m) {
                    EngagementBand& below = out.bands[m - 1];
                    if (below.z1_mm == z0 && level.s0 >= profile_.corner_end() &&
                        std::abs(below.entry_rad - from) < kAlikeRad &&
                        std::abs(below.exit_rad - to) < kAlikeRad) {
                        const double share = (z1 - z0) / (z1 - below.z0_mm);
                        below.entry_rad += share * (from - below.entry_rad);
                        below.exit_rad += share * (to - below.exit_rad);
                        below.z1_mm = z1;
                        return;
                    }
                }
                out.bands.push_back({z0, z1, from, to});
            };
            for (const double turn : {-math::kTwoPi, 0.0, math::kTwoPi})
                add(arc.from_rad + turn, arc.to_rad + turn);
        }
    }
}

void EngagementProbe::measure(const field::CarvedView& stock, const CutPose& pose, Engagement& out) {
    out.clear();
    double low, high;
    if (!clip_heights(stock, pose, low, high)) return;
    const double bottom = profile_.bottom_end(), corner = profile_.corner_end();
    if (low <= 0 && bottom > core_mm_ && (pose.travel.down_mm > 0 || pose.travel.turns())) {
        levels_.clear();
        arcs_.clear();
        start(core_mm_, bottom, stock, pose);
        refine(stock, pose);
        add_bands(pose, out);
    }
    const double s0 = profile_.at_height(low), s1 = profile_.at_height(high);
    const double middle = std::clamp(corner, s0, s1);
    levels_.clear();
    arcs_.clear();
    if (middle > s0) start(s0, middle, stock, pose);
    if (s1 > middle) start(middle, s1, stock, pose);
    refine(stock, pose);
    add_bands(pose, out);
}

double chip_mm3(const Cutter& cutter, const Engagement& engagement, const ToolTravel& travel) {
    const CutterProfile profile(cutter);
    // Gauss-Legendre along the meridian, in closed form over the rotation.
    constexpr double kPlace[3] = {-0.77459666924148337704, 0, 0.77459666924148337704};
    constexpr double kWeight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    double volume = 0;
    const auto add_piece = [&](double s0, double s1, double entry, double exit) {
        for (int n = 0; n < 3; ++n) {
            const ProfilePoint at = profile.at(0.5 * (s0 + s1) + 0.5 * (s1 - s0) * kPlace[n]);
            const TurnLaw law = normal_travel(travel, at);
            const Window window = outward(law, 0);
            const double weight = kWeight[n] * (s1 - s0) * at.radius_mm;
            for (int turn = -1; turn <= 1; ++turn) {
                const double from = std::max(entry, window.from + turn * math::kTwoPi);
                const double to = std::min(exit, window.to + turn * math::kTwoPi);
                if (!(to > from)) continue;
                volume += weight * integral(law, from, to);
            }
        }
    };
    // Where the axis turns, the window in which an edge moves outward has kinks along the meridian.
    const int pieces = travel.turns() ? 6 : 1;
    const auto add = [&](double s0, double s1, double entry, double exit) {
        for (int n = 0; n < pieces && s1 > s0; ++n)
            add_piece(s0 + (s1 - s0) * n / pieces, s0 + (s1 - s0) * (n + 1) / pieces, entry, exit);
    };
    for (const BottomBand& b : engagement.bottom) add(b.r0_mm, b.r1_mm, b.entry_rad, b.exit_rad);
    for (const EngagementBand& b : engagement.bands) {
        const double s0 = profile.at_height(b.z0_mm), s1 = profile.at_height(b.z1_mm);
        const double middle = std::clamp(profile.corner_end(), s0, s1);
        add(s0, middle, b.entry_rad, b.exit_rad);
        add(middle, s1, b.entry_rad, b.exit_rad);
    }
    return volume;
}

}  // namespace tribo::milling
