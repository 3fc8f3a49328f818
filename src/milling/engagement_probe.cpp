// SPDX-License-Identifier: MIT
#include "milling/engagement_probe.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/math.hpp"

namespace tribo::milling {
namespace {

// Material thinner than this in front of the edge is what rounding leaves where the cutter runs along a
// surface that it has made before.
constexpr double kSkin = 2e-5;  // mm
// Levels looked at along the engaged height before refinement.
constexpr int kLevels = 7;
// Masks that differ by more probes than this have a step between them, which is searched for.
constexpr int kStepProbes = 2;

}  // namespace

ToolFrame tool_frame(Vec3 axis, Vec3 travel, Vec3 last_x) {
    const Vec3 across = travel - dot(travel, axis) * axis;
    // Below this share the direction across the axis is rounding.
    constexpr double kPlunge = 1e-6;
    ToolFrame f;
    f.z = axis;
    if (length(across) > kPlunge * length(travel)) {
        f.x = normalized(across);
    } else {
        const Vec3 last = last_x - dot(last_x, axis) * axis;
        f.x = normalized(last, any_perpendicular(axis));
    }
    f.y = cross(f.z, f.x);
    return f;
}

EngagementProbe::EngagementProbe(const Cutter& cutter) : cutter_(cutter) {
    for (int n = 0; n < kAngles; ++n) {
        math::sincos((n + 0.5) * math::kTwoPi / kAngles, sin_[n], cos_[n]);
    }
    levels_.reserve(64);
}

double EngagementProbe::least_sine(const CutPose& pose, double z) const {
    const double corner = cutter_.corner_radius_mm();
    if (z >= corner) return 0;
    // Normal times travel: across sin(phi) sin(kappa) + down cos(kappa).
    const double cos_kappa = 1 - z / corner, sin_kappa = std::sqrt(std::max(0.0, 1 - cos_kappa * cos_kappa));
    const double side = pose.across * sin_kappa, under = pose.down * cos_kappa;
    if (side > std::abs(under)) return -under / side;
    return under > 0 ? -1 : 1;
}

EngagementProbe::Mask EngagementProbe::look(const field::CarvedView& stock, const CutPose& pose, double z,
                                            Mask asked) const {
    const double r = cutter_.radius_at(z), least = least_sine(pose, z);
    const Vec3 centre = pose.tip_mm + z * pose.frame.z, x = r * pose.frame.x, y = r * pose.frame.y;
    Mask mask = 0;
    for (int n = 0; n < kAngles; ++n) {
        if ((asked >> n & 1) != 0 && sin_[n] > least &&
            stock.is_material(centre + sin_[n] * x + cos_[n] * y, kSkin))
            mask |= Mask{1} << n;
    }
    return mask;
}

EngagementProbe::Mask EngagementProbe::look_again(const field::CarvedView& stock, const CutPose& pose,
                                                  double z, Mask like) const {
    constexpr Mask kAll = (Mask{1} << kAngles) - 1, kEven = kAll / 3;
    const Mask even = look(stock, pose, z, kEven);
    if (even != (like & kEven)) return even | look(stock, pose, z, kAll & ~kEven);
    const Mask starts = like ^ ((like << 1 | like >> (kAngles - 1)) & kAll);
    const Mask beside = (starts | starts >> 1 | starts << (kAngles - 1)) & kAll & ~kEven;
    return (like & ~beside) | look(stock, pose, z, beside);
}

double EngagementProbe::refine(const field::CarvedView& stock, const CutPose& pose, double z, double outside,
                               double inside) const {
    const auto depth = [&](double angle) {
        double s, c;
        math::sincos(angle, s, c);
        const double r = cutter_.radius_at(z);
        return stock.distance_mm(pose.tip_mm + z * pose.frame.z + r * s * pose.frame.x +
                                 r * c * pose.frame.y) +
               kSkin;
    };
    // Regula falsi in the Illinois form on the exact distance.
    constexpr int kSteps = 8;
    constexpr double kAngle = 5e-4, kDepth = 1e-4;  // rad, mm
    double out = depth(outside), in = depth(inside);
    if (out < 0) return outside;
    double angle = inside;
    int last = 0;
    for (int n = 0; n < kSteps && std::abs(inside - outside) > kAngle; ++n) {
        angle = in < out ? outside + (inside - outside) * out / (out - in) : 0.5 * (inside + outside);
        const double d = depth(angle);
        if (std::abs(d) < kDepth) break;
        const int side = d < 0 ? 1 : -1;
        if (side > 0) {
            inside = angle;
            in = d;
            if (last > 0) out *= 0.5;
        } else {
            outside = angle;
            out = d;
            if (last < 0) in *= 0.5;
        }
        last = side;
    }
    return angle;
}

void EngagementProbe::add_bands(const field::CarvedView& stock, const CutPose& pose, Mask mask, double z0,
                                double z1, Engagement& out) const {
    const double least = least_sine(pose, 0.5 * (z0 + z1));
    if (least <= -1) {
        add_window(stock, pose, mask, {z0, z1, 0, math::kTwoPi}, out);
        return;
    }
    const double border = math::asin(std::min(least, 1.0));
    add_window(stock, pose, mask, {z0, z1, std::max(border, 0.0), math::kPi - border}, out);
    if (border < 0) add_window(stock, pose, mask, {z0, z1, math::kTwoPi + border, math::kTwoPi}, out);
}

void EngagementProbe::add_window(const field::CarvedView& stock, const CutPose& pose, Mask mask,
                                 EngagementBand window, Engagement& out) const {
    // Within this of the window's end an interval ends there exactly: beyond it nothing is cut.
    constexpr double kSide = 0.01;  // rad
    const double step = math::kTwoPi / kAngles, z = 0.5 * (window.z0_mm + window.z1_mm);
    const int first = std::max(0, static_cast<int>(std::ceil(window.entry_rad / step - 0.5)));
    const int last = std::min(kAngles - 1, static_cast<int>(std::floor(window.exit_rad / step - 0.5)));
    const auto bit = [&](int n) { return (mask >> n & 1) != 0; };
    for (int n = first; n <= last; ++n) {
        if (!bit(n)) continue;
        int end = n;
        while (end < last && bit(end + 1)) ++end;
        const double before = n == first ? window.entry_rad : (n - 0.5) * step;
        const double after = end == last ? window.exit_rad : (end + 1.5) * step;
        double entry = refine(stock, pose, z, before, (n + 0.5) * step);
        double exit = refine(stock, pose, z, after, (end + 0.5) * step);
        if (entry - window.entry_rad < kSide) entry = window.entry_rad;
        if (window.exit_rad - exit < kSide) exit = window.exit_rad;
        if (exit > entry) out.bands.push_back({window.z0_mm, window.z1_mm, entry, exit});
        n = end;
    }
}

double EngagementProbe::bottom_fraction(const field::CarvedView& stock, const CutPose& pose) const {
    const double radius = cutter_.radius_mm() - cutter_.corner_radius_mm();
    if (pose.down <= 1e-9 || radius <= 0) return 0;
    constexpr int kRings = 6;
    int in = 0, of = 0;
    for (int ring = 0; ring < kRings; ++ring) {
        // Rings of equal area, so that every probe stands for the same share of the disc.
        const double r = radius * std::sqrt((ring + 0.5) / kRings);
        for (int n = ring % 4; n < kAngles; n += 4, ++of) {
            const Vec3 p = pose.tip_mm + r * sin_[n] * pose.frame.x + r * cos_[n] * pose.frame.y;
            in += static_cast<int>(stock.is_material(p, kSkin));
        }
    }
    return static_cast<double>(in) / of;
}

void EngagementProbe::measure(const field::CarvedView& stock, const CutPose& pose, Engagement& out) {
    out.clear();
    const double corner = cutter_.corner_radius_mm(), radius = cutter_.radius_mm();
    // Heights at which the envelope can meet the blank at all.
    const Box3 blank = stock.field().blank().bounds_mm();
    double low = 0, high = cutter_.length_mm;
    for (int axis = 0; axis < 3; ++axis) {
        const double u = pose.frame.z[axis];
        const double reach = radius * std::sqrt(std::max(0.0, 1 - u * u));
        const double from = blank.min[axis] - reach - pose.tip_mm[axis];
        const double to = blank.max[axis] + reach - pose.tip_mm[axis];
        if (std::abs(u) < 1e-12) {
            if (from > 0 || to < 0) return;
            continue;
        }
        low = std::max(low, std::min(from / u, to / u));
        high = std::min(high, std::max(from / u, to / u));
    }
    if (high <= low) return;
    out.bottom_fraction = bottom_fraction(stock, pose);

    levels_.clear();
    const auto add_level = [&](double z) {
        levels_.push_back({z, levels_.empty() ? look(stock, pose, z, ~Mask{0})
                                              : look_again(stock, pose, z, levels_.back().mask)});
    };
    const double round_top = std::clamp(corner, low, high);
    if (round_top > low) {
        // Through the rounded part in equal steps of the surface's angle, where the radius changes fast.
        const auto angle_at = [&](double z) { return math::acos(std::clamp(1 - z / corner, -1.0, 1.0)); };
        const double k0 = angle_at(low), k1 = angle_at(round_top);
        const int count = std::max(2, static_cast<int>(std::ceil((k1 - k0) / 0.15)));
        for (int n = 0; n < count; ++n) {
            add_level(corner * (1 - math::cos(k0 + (k1 - k0) * (n + 0.5) / count)));
        }
    }
    if (high > round_top) {
        const double bottom = levels_.empty() ? low : round_top;
        // Where the tool climbs or dives, what it meets just above its bottom is thin and changes fast.
        if (levels_.empty()) add_level(low + 0.01 * (high - low));
        for (int n = 0; n < kLevels; ++n) add_level(bottom + (high - bottom) * (n + 0.5) / kLevels);
    }

    // Between levels that differ by more than a few probes lies a step or a slope: look there until they
    // agree or the step is as thin as heights are wanted. What both say is taken for what is between.
    const double fine = std::max(0.002 * (high - low), 0.001);
    for (std::size_t n = 0; n + 1 < levels_.size();) {
        const Level below = levels_[n], above = levels_[n + 1];
        const Mask changed = below.mask ^ above.mask;
        if (std::popcount(changed) <= kStepProbes || above.z - below.z <= fine) {
            ++n;
            continue;
        }
        const double z = 0.5 * (below.z + above.z);
        levels_.insert(levels_.begin() + static_cast<std::ptrdiff_t>(n) + 1,
                       {z, (below.mask & ~changed) | look(stock, pose, z, changed)});
    }
    // Each level stands for the heights that are nearer to it than to its neighbours; alike ones on the
    // cylinder are one.
    for (std::size_t n = 0; n < levels_.size();) {
        std::size_t end = n + 1;
        const double z0 = n == 0 ? low : 0.5 * (levels_[n - 1].z + levels_[n].z);
        while (end < levels_.size() && levels_[end].mask == levels_[n].mask && z0 >= corner) ++end;
        const double z1 = end == levels_.size() ? high : 0.5 * (levels_[end - 1].z + levels_[end].z);
        if (levels_[n].mask != 0) add_bands(stock, pose, levels_[n].mask, z0, z1, out);
        n = end;
    }
}

double chip_area_mm2(const Cutter& cutter, const Engagement& engagement, double across, double down) {
    const double corner = cutter.corner_radius_mm(), core = cutter.radius_mm() - corner;
    double area = 0;
    for (const EngagementBand& b : engagement.bands) {
        double s0, c0, s1, c1;
        math::sincos(b.entry_rad, s0, c0);
        math::sincos(b.exit_rad, s1, c1);
        // The front of the envelope seen along the travel: its width times the height, and in the rounded
        // part the ring seen from below times the share of travel along the axis.
        const double z0 = std::min(b.z0_mm, corner), z1 = std::min(b.z1_mm, corner);
        const double r0 = cutter.radius_at(b.z0_mm), r1 = cutter.radius_at(b.z1_mm);
        double profile = cutter.radius_mm() * (b.z1_mm - std::max(b.z0_mm, corner));
        if (b.z1_mm <= corner) profile = 0;
        if (z1 > z0) {
            // Integral of r(z) over the rounded part: the core and a piece of the circle.
            const auto circle = [&](double z) {
                const double u = std::clamp(z / corner - 1, -1.0, 1.0);
                return 0.5 * corner * corner * (u * std::sqrt(1 - u * u) + math::asin(u));
            };
            profile += core * (z1 - z0) + circle(z1) - circle(z0);
            area += down * 0.5 * (r1 * r1 - r0 * r0) * (b.exit_rad - b.entry_rad);
        }
        area += across * profile * (c0 - c1);
    }
    if (down > 0) area += down * engagement.bottom_fraction * math::kPi * core * core;
    return area;
}

}  // namespace tribo::milling
