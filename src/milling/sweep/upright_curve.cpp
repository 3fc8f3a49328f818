// SPDX-License-Identifier: MIT
#include "milling/sweep/upright_curve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tribo::milling {
namespace {

constexpr int kMostSteps = 40;
// Of t. A rate of change is off by some ulps of its largest term.
constexpr double kStill = 1e-13, kUlps = 1e-15;

Vec3 across(Vec3 v, Vec3 axis) {
    return v - dot(v, axis) * axis;
}

}  // namespace

std::optional<UprightCurve> UprightCurve::of(const ToolProfile& tool, const CurvedLine& line) {
    constexpr double kTurn = 1e-12, kUneven = 1e-9;  // rad, mm
    if (tool.kind == CutterKind::bull || line.bounds.turn > kTurn) return std::nullopt;
    UprightCurve c;
    c.kind_ = tool.kind;
    c.radius_mm_ = tool.radius_mm;
    c.axis_ = normalized(line.axis0);
    if (std::abs(dot(line.tip2, c.axis_)) > kUneven) return std::nullopt;
    c.rise_mm_ = dot(line.tip1 + line.tip2, c.axis_);
    c.first_ = across(line.tip1, c.axis_);
    c.second_ = across(line.tip2, c.axis_);
    c.first_squared_ = squared_length(c.first_);
    c.second_squared_ = squared_length(c.second_);
    c.turned_ = dot(c.first_, c.second_);
    const double least_speed = std::max(0.0, length(c.first_) - 2 * length(c.second_));
    c.least_speed_squared_ = least_speed * least_speed;
    c.turned_back_ = std::min(0.0, c.turned_);
    return c;
}

double UprightCurve::HalfRate::rounding() const {
    return kStill + kUlps * std::abs(of_one) / std::max(of_t, 1e-300);
}

double UprightCurve::squared_mm2(Vec3 point, double t) const {
    return squared_length(point - t * (first_ + t * second_));
}

UprightCurve::HalfRate UprightCurve::half_rate(Vec3 point) const {
    return {-dot(point, first_), first_squared_ - 2 * dot(point, second_), 3 * turned_, 2 * second_squared_};
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

UprightCurve::Nearest UprightCurve::nearest_of_flat(Vec3 point, double height) const {
    const auto side = [&](double t) { return std::sqrt(squared_mm2(point, t)) - radius_mm_; };
    const auto bottom = [&](double t) { return t * rise_mm_ - height; };
    const HalfRate rate = half_rate(point);
    const double chord = dot(point, first_) / std::max(first_squared_, 1e-300);
    const double t = zero_of(std::clamp(chord, 0.0, 1.0), rate.rounding(),
                             [&](double at) { return std::pair{rate.at(at), rate.slope(at)}; });
    const double beside = side(t);
    if (beside >= bottom(t) || rise_mm_ == 0) return {std::max(beside, bottom(t)), t};
    // Below the bottom: the tool comes nearer where it is higher, as far as its edge.
    const double end = rise_mm_ > 0 ? 0 : 1;
    if (side(end) <= bottom(end)) return {bottom(end), end};
    double in = t, out = end, below = beside - bottom(t), above = side(end) - bottom(end);
    double at = t;
    for (int n = 0, last = 0; n < 2 * kMostSteps && std::abs(out - in) > kStill; ++n) {
        at = in + (out - in) * below / (below - above);
        const double gap = side(at) - bottom(at);
        if (gap == 0) break;
        // Regula falsi in the Illinois form.
        if (gap < 0) {
            in = at;
            below = gap;
            if (last < 0) above *= 0.5;
            last = -1;
        } else {
            out = at;
            above = gap;
            if (last > 0) below *= 0.5;
            last = 1;
        }
        if (std::abs(gap) < 1e-12) break;
    }
    return {std::max(side(at), bottom(at)), at};
}

UprightCurve::Nearest UprightCurve::nearest_of_ball(Vec3 point, double height) const {
    const auto under = [&](double t) { return std::min(height - t * rise_mm_ - radius_mm_, 0.0); };
    const HalfRate rate = half_rate(point);
    const Vec3 way = first_ + second_;
    const double chord = dot(point, way) + (height - radius_mm_) * rise_mm_;
    const double t =
        zero_of(std::clamp(chord / std::max(squared_length(way) + rise_mm_ * rise_mm_, 1e-300), 0.0, 1.0),
                rate.rounding(), [&](double at) {
                    const double below = under(at);
                    return std::pair{rate.at(at) - below * rise_mm_,
                                     rate.slope(at) + (below < 0 ? rise_mm_ * rise_mm_ : 0)};
                });
    const double below = under(t);
    return {std::sqrt(squared_mm2(point, t) + below * below) - radius_mm_, t};
}

std::optional<UprightCurve::Nearest> UprightCurve::nearest(Vec3 d) const {
    const double height = dot(d, axis_);
    const Vec3 point = d - height * axis_;
    // The square of the distance to the axis is convex in t: then one instant is nearest.
    if (!(least_speed_squared_ > 2.1 * (dot(point, second_) - turned_back_) && least_speed_squared_ > 0))
        return std::nullopt;
    return kind_ == CutterKind::ball ? nearest_of_ball(point, height) : nearest_of_flat(point, height);
}

double UprightCurve::lowest_mm(Vec3 d) const {
    return dot(d, axis_) - std::max(rise_mm_, 0.0);
}

}  // namespace tribo::milling
