// SPDX-License-Identifier: MIT
#include "milling/sweep/upright_curve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tribo::milling {
namespace {

constexpr int kMostSteps = 40;
// Of t: the last step of Newton's method, whose error is about its square. A rate of change is off by some
// ulps of its largest term.
constexpr double kStill = 1e-8, kUlps = 1e-15;
constexpr double kOnEdge = 1e-12;  // mm

Vec3 across(Vec3 v, Vec3 axis) {
    return v - dot(v, axis) * axis;
}

}  // namespace

std::optional<UprightCurve> UprightCurve::of(const ToolProfile& tool, const CurvedLine& line) {
    constexpr double kTurn = 1e-12, kUneven = 1e-9, kRounding = 1e-12;  // rad, mm, share
    if (tool.kind == CutterKind::bull || line.bounds.turn > kTurn) return std::nullopt;
    UprightCurve c;
    c.kind_ = tool.kind;
    c.radius_mm_ = tool.radius_mm;
    const Vec3 z = normalized(line.axis0);
    if (std::abs(dot(line.tip2, z)) > kUneven) return std::nullopt;
    const Vec3 way = across(line.tip1, z);
    // Of a steep travel little is across the axis, and rounding makes that oblique.
    const Vec3 x = length(way) > kRounding * length(line.tip1) ? normalized(across(normalized(way), z))
                                                               : any_perpendicular(z);
    c.frame_ = {x, cross(z, x), z};
    const Vec3 first = c.frame_.into(line.tip1), second = c.frame_.into(line.tip2);
    const double squared = second.x * second.x + second.y * second.y, turned = first.x * second.x;
    // Half of the second derivative of the square is first^2 + 6 t first second + 6 t^2 second^2, less twice
    // the product of the point and `second`; at this t the rest is least.
    const double flattest = std::clamp(-turned / std::max(2 * squared, 1e-300), 0.0, 1.0);
    const double least = first.x * first.x + 6 * flattest * (turned + flattest * squared);
    // Closer to zero Newton's method has no hold.
    constexpr double kLeast = 0.025;
    c.line_ = {first.x, second.x, second.y, first.z + second.z, 0.5 * (least - kLeast * first.x * first.x)};
    c.sag_mm_ = 0.25 * std::sqrt(squared);
    return c;
}

double UprightCurve::HalfRate::rounding() const {
    return kStill + kUlps * std::abs(of_one) / std::max(of_t, 1e-300);
}

double UprightCurve::squared_mm2(Vec3 point, double t) const {
    const double x = point.x - t * (line_.across + t * line_.bend_x), y = point.y - t * t * line_.bend_y;
    return x * x + y * y;
}

UprightCurve::HalfRate UprightCurve::half_rate(Vec3 point) const {
    const UprightLine& l = line_;
    return {-point.x * l.across, l.across * l.across - 2 * (point.x * l.bend_x + point.y * l.bend_y),
            3 * l.across * l.bend_x, 2 * (l.bend_x * l.bend_x + l.bend_y * l.bend_y)};
}

template <class F>
double UprightCurve::zero_of(double start, double still, const F& value_and_slope) {
    double low = 0, high = 1, t = start;
    bool knows_low = false, knows_high = false;
    for (int n = 0; n < kMostSteps; ++n) {
        const auto [value, slope] = value_and_slope(t);
        if ((t == 0 && value >= 0) || (t == 1 && value <= 0)) return t;
        (value > 0 ? high : low) = t;
        (value > 0 ? knows_high : knows_low) = true;
        // Newton's step within what is left; where it leads out of it, the end or the middle. Rounding
        // decides the side of the last steps: they must not lead back to the middle.
        double next = t - value / slope;
        if (std::abs(next - t) < still) return std::clamp(next, 0.0, 1.0);
        if (next <= low) next = knows_low ? 0.5 * (low + high) : 0;
        if (next >= high) next = knows_high ? 0.5 * (low + high) : 1;
        t = next;
    }
    return t;
}

UprightCurve::Nearest UprightCurve::nearest_of_flat(Vec3 point) const {
    const auto side = [&](double t) { return std::sqrt(squared_mm2(point, t)) - radius_mm_; };
    const auto bottom = [&](double t) { return t * line_.rise - point.z; };
    const HalfRate rate = half_rate(point);
    const double chord = point.x / std::max(line_.across, 1e-300);
    const double t = zero_of(std::clamp(chord, 0.0, 1.0), rate.rounding(),
                             [&](double at) { return std::pair{rate.at(at), rate.slope(at)}; });
    const double beside = side(t);
    if (beside >= bottom(t) || line_.rise == 0) return {std::max(beside, bottom(t)), t};
    // Below the bottom: the tool comes nearer where it is lower, as far as its edge.
    const double end = line_.rise > 0 ? 0 : 1;
    if (side(end) <= bottom(end)) return {bottom(end), end};
    double in = t, out = end, at = end;
    for (int n = 0; n < kMostSteps; ++n) {
        const double gap = side(at) - bottom(at);
        if (std::abs(gap) < kOnEdge) break;
        (gap < 0 ? in : out) = at;
        // Newton's step; where it leads out of what is left, the middle.
        double next = at - gap / (rate.at(at) / (side(at) + radius_mm_) - line_.rise);
        if (!(std::min(in, out) < next && next < std::max(in, out))) next = 0.5 * (in + out);
        if (std::abs(std::exchange(at, next) - next) < kStill) break;
    }
    return {std::max(side(at), bottom(at)), at};
}

UprightCurve::Nearest UprightCurve::nearest_of_ball(Vec3 point) const {
    const double height = point.z - radius_mm_, rise = line_.rise;
    const auto under = [&](double t) { return std::min(height - t * rise, 0.0); };
    const HalfRate rate = half_rate(point);
    const Vec3 way{line_.across + line_.bend_x, line_.bend_y, rise};
    const double chord = dot({point.x, point.y, height}, way) / std::max(squared_length(way), 1e-300);
    const double t = zero_of(std::clamp(chord, 0.0, 1.0), rate.rounding(), [&](double at) {
        const double below = under(at);
        return std::pair{rate.at(at) - below * rise, rate.slope(at) + (below < 0 ? rise * rise : 0)};
    });
    const double below = under(t);
    return {std::sqrt(squared_mm2(point, t) + below * below) - radius_mm_, t};
}

std::optional<UprightCurve::Nearest> UprightCurve::nearest(Vec3 d) const {
    const Vec3 point = frame_.into(d);
    // Where the square of the distance to the axis is convex, one instant is nearest.
    if (!(point.x * line_.bend_x + point.y * line_.bend_y < line_.convex_below)) return std::nullopt;
    return kind_ == CutterKind::ball ? nearest_of_ball(point) : nearest_of_flat(point);
}

bool UprightCurve::is_beyond(Vec3 d, double bound_mm) const {
    const Vec3 point = frame_.into(d);
    if (std::min(line_.rise, 0.0) - point.z >= bound_mm) return true;
    const double reach = radius_mm_ + sag_mm_ + bound_mm;
    if (reach <= 0) return false;
    const Vec3 way{line_.across + line_.bend_x, line_.bend_y, 0}, from{point.x, point.y, 0};
    const double t = std::clamp(dot(from, way) / std::max(squared_length(way), 1e-300), 0.0, 1.0);
    return squared_length(from - t * way) >= reach * reach;
}

double UprightCurve::lowest_mm(Vec3 d) const {
    return dot(d, frame_.z) - std::max(line_.rise, 0.0);
}

}  // namespace tribo::milling
