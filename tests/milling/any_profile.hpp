// SPDX-License-Identifier: MIT
// Cutters of every kind with a profile, drawn at random, and the distance to one at rest from its vertices
// alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "base/math.hpp"
#include "milling/tool/cutter_shape.hpp"
#include "motion/path/program.hpp"

namespace tribo::milling {

inline double drawn(double lo, double hi) {
    return lo + (hi - lo) * 1e-6 * *rc::gen::inRange(0, 1000001);
}

inline Cutter finished(Cutter cutter) {
    const auto done = make_profile(cutter);
    EXPECT_TRUE(done) << done.error().text();
    return cutter;
}

// A pilot, a hollow corner, a step, an undercut and a neck: all that a profile can have.
inline Cutter form_tool() {
    Cutter c{.kind = CutterKind::profile, .length_mm = 0};
    const double r = drawn(0.5, 2), hollow = drawn(0.3, 2), step = drawn(0.2, 1), tall = drawn(0.3, 2);
    c.profile = {{r, 0, 0},
                 {r, tall, -std::tan(0.125 * drawn(0.3, 3.1))},
                 {r + hollow, tall + hollow, 0},
                 {r + hollow + step, tall + hollow, 0},
                 {r + hollow + step, tall + hollow + step, std::tan(0.125 * drawn(0.2, 1.5))},
                 {r + hollow + 0.5 * step, 2 * tall + hollow + step, 0},
                 {r + hollow, 2 * tall + hollow + step, 0},
                 {r + hollow, 3 * tall + hollow + step + 5, 0}};
    if (*rc::gen::inRange(0, 3) == 0) c.profile[1].bulge = -std::tan(math::kPi / 8);
    // Without its step the hollow corner ends in an edge that stands out.
    if (*rc::gen::inRange(0, 2) == 0) {
        c.profile = {c.profile[0], c.profile[1], c.profile[2], {r + hollow, 2 * tall + hollow, 0}};
        return finished(c);
    }
    if (!make_profile(c)) {
        c.profile[1].bulge = -std::tan(math::kPi / 8);
        c.profile[4].bulge = 0;
    }
    return finished(c);
}

inline Cutter any_profile(CutterKind kind) {
    const double d = drawn(2, 12), r = 0.5 * d;
    Cutter c{.kind = kind, .diameter_mm = d, .length_mm = 0};
    switch (kind) {
        case CutterKind::taper:
            c.taper_deg = drawn(2, 30);
            c.tip_mm = drawn(0.2, 0.8) * d;
            c.corner_mm = *rc::gen::inRange(0, 2) * drawn(0.1, 1) * 0.5 * c.tip_mm;
            break;
        case CutterKind::v:
        case CutterKind::engraver:
            c.point_deg = drawn(20, 150);
            c.corner_mm = *rc::gen::inRange(0, 2) * drawn(0.05, 0.3) * r;
            c.tip_mm = *rc::gen::inRange(0, 2) * std::max(drawn(0.05, 0.5) * d, 2 * c.corner_mm);
            break;
        case CutterKind::drill:
            c.point_deg = drawn(60, 160);
            break;
        case CutterKind::chamfer:
        case CutterKind::countersink:
            c.point_deg = drawn(40, 140);
            c.tip_mm = drawn(0, 0.7) * d;
            break;
        case CutterKind::dovetail:
            c.taper_deg = drawn(5, 50);
            c.height_mm = drawn(0.3, 0.7) * r / std::tan(c.taper_deg * math::kRadPerDeg);
            c.corner_mm = *rc::gen::inRange(0, 2) * drawn(0.02, 0.2) * std::min(r, c.height_mm);
            break;
        case CutterKind::lens:
            c.side_mm = drawn(0.6, 4) * d;
            c.corner_mm = *rc::gen::inRange(0, 2) * drawn(0.05, 0.9) * r;
            break;
        case CutterKind::barrel:
            c.length_mm = drawn(1, 3) * d;
            c.side_mm = drawn(4, 12) * c.length_mm;
            c.corner_mm = *rc::gen::inRange(0, 2) * drawn(0.05, 0.5) * r;
            break;
        case CutterKind::lollipop:
            c.neck_mm = drawn(0.2, 0.9) * d;
            break;
        case CutterKind::thread:
            c.neck_mm = drawn(0.4, 0.9) * d;
            c.point_deg = drawn(20, 90);
            c.tip_mm = *rc::gen::inRange(0, 2) * drawn(0.02, 0.5);
            break;
        default:
            return form_tool();
    }
    return finished(c);
}
inline Cutter any_profile() {
    constexpr auto first = static_cast<int>(CutterKind::taper), last = static_cast<int>(CutterKind::profile);
    return any_profile(static_cast<CutterKind>(*rc::gen::inRange(first, last + 1)));
}

// The distance in the half plane: to each line and arc, with the side from the radius at the point's height.
// Angles where the engine has bulges.
struct DrawnPoint {
    double distance_mm, radius_mm;  // of the drawing at this height; < 0 above and below it
};
inline DrawnPoint drawn_point(const Cutter& c, double rho, double z) {
    double nearest = 1e300, radius_here = -1, last_r = 0, last_z = 0, bulge = 0;
    const auto to = [&](double r, double h) { nearest = std::min(nearest, std::hypot(rho - r, z - h)); };
    const auto piece = [&](double r, double h) {
        const double dr = r - last_r, dz = h - last_z, size = std::hypot(dr, dz);
        if (size == 0) return;
        const bool here = z >= last_z && z <= h && h > last_z;
        to(last_r, last_z);
        to(r, h);
        if (bulge == 0) {
            const double share =
                std::clamp(((rho - last_r) * dr + (z - last_z) * dz) / (size * size), 0.0, 1.0);
            to(last_r + share * dr, last_z + share * dz);
            if (here) radius_here = std::max(radius_here, last_r + dr * (z - last_z) / (h - last_z));
            return;
        }
        const double half = 2 * std::atan(std::abs(bulge)), radius = 0.5 * size / std::sin(half);
        const double off = radius * std::cos(half) * (bulge > 0 ? 1 : -1);
        const double cr = last_r + 0.5 * dr - off * dz / size, cz = last_z + 0.5 * dz + off * dr / size;
        const double side = bulge > 0 ? 1 : -1;
        // The middle of the arc lies across the chord from the centre.
        const double middle = std::atan2(-side * dr, side * dz);
        const double at = std::atan2(z - cz, rho - cr);
        if (std::abs(std::remainder(at - middle, 2 * math::kPi)) < half)
            to(cr + radius * std::cos(at), cz + radius * std::sin(at));
        if (here)
            radius_here = std::max(
                radius_here, cr + side * std::sqrt(std::max(radius * radius - (z - cz) * (z - cz), 0.0)));
    };
    for (const ProfileVertex& v : c.profile) {
        piece(v.r_mm, v.z_mm);
        last_r = v.r_mm, last_z = v.z_mm, bulge = v.bulge;
    }
    piece(last_r, c.length_mm);
    last_z = c.length_mm, bulge = 0;
    piece(0, c.length_mm);
    return {rho < radius_here ? -nearest : nearest, radius_here};
}

inline double profile_distance(const Cutter& c, double rho, double z) {
    return drawn_point(c, rho, z).distance_mm;
}

inline double profile_distance(const Cutter& c, const motion::ToolPose& pose, Vec3 p) {
    const Vec3 d = p - pose.tip_mm;
    const double z = dot(d, pose.axis);
    return profile_distance(c, length(d - z * pose.axis), z);
}

}  // namespace tribo::milling
