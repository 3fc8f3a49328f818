// SPDX-License-Identifier: MIT
#include "milling/sweep/scallop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.hpp"

namespace tribo::milling {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Number of bisections: to the last bit of a double.
constexpr int kBisections = 60;

// The lower outline of the tool seen along the feed, y across it and z along the surface normal. It is the
// ellipse {e1 cos + e2 sin} of the circle that carries the corner, grown by the corner. On both sides the
// flank begins where the normal of the outline is perpendicular to the tool axis.
struct Outline {
    double e1y, e2y, e2z;  // e1z = 0
    double corner;
    double lean;   // +1 if the axis leans towards +y, -1 towards -y
    double slope;  // of the flank: |dy / dz|
    double flank;  // angle of the normal at which the flank begins on the side of the lean, 0..pi/2

    Outline(const Cutter& cutter, Inclination inclination) : corner(cutter.corner_radius_mm()) {
        double sin_tilt = 0, cos_tilt = 1, sin_turn = 0, cos_turn = 1;
        math::sincos(inclination.tilt_rad, sin_tilt, cos_tilt);
        math::sincos(inclination.turn_rad, sin_turn, cos_turn);
        const double radius = cutter.radius_mm() - corner;
        e1y = radius * cos_turn;
        e2y = -radius * cos_tilt * sin_turn;
        e2z = radius * sin_tilt;
        lean = sin_turn < 0 ? -1 : 1;
        slope = sin_tilt * std::abs(sin_turn) / cos_tilt;
        flank = math::atan2(1, slope);
    }

    struct Point {
        double y, height;
    };
    // Returns the point whose outer normal is `angle` off straight down, towards +y; its height is above the
    // lowest point.
    Point at(double angle) const {
        double s = 0, c = 1;
        math::sincos(angle, s, c);
        const double a = e1y * s, b = e2y * s - e2z * c;  // e1, e2 along the normal (s, -c)
        const double support = std::sqrt(a * a + b * b);
        if (support == 0) return {corner * s, corner * (1 - c)};
        return {(e1y * a + e2y * b) / support + corner * s, e2z * b / support + e2z + corner * (1 - c)};
    }
    // Returns the angle at which the flank begins, on the side of `sign`.
    double last_angle(double sign) const { return sign * (sign == lean ? flank : math::kPi - flank); }
    // Returns y of the outline at this height, on the side of `sign`.
    double reach(double height, double sign) const {
        double low = 0, high = last_angle(sign);
        const Point last = at(high);
        if (last.height <= height) return last.y + lean * slope * (height - last.height);
        for (int i = 0; i < kBisections; ++i) {
            const double middle = 0.5 * (low + high);
            (at(middle).height > height ? high : low) = middle;
        }
        return at(high).y;
    }
    double width(double height) const { return reach(height, 1) - reach(height, -1); }
    // Below flank_height() the outline is the curve alone, above full_height() the flank alone.
    double flank_height() const { return at(last_angle(lean)).height; }
    double full_height() const { return at(last_angle(-lean)).height; }
};

// Returns the height of a circle of radius r over a chord of this length, without cancellation.
double sagitta(double r, double chord) {
    const double half = 0.5 * chord;
    return half * half / (r + std::sqrt(r * r - half * half));
}

}  // namespace

double effective_width_mm(const Cutter& cutter, Inclination inclination, double height_mm) {
    const double radius = cutter.radius_mm(), corner = cutter.corner_radius_mm();
    const Outline outline(cutter, inclination);
    if (height_mm > outline.flank_height()) return outline.width(height_mm);
    if (corner == radius) return 2 * std::sqrt(height_mm * (2 * radius - height_mm));
    const double depth = radius * math::sin(inclination.tilt_rad);
    if (corner > 0 || depth == 0) return outline.width(height_mm);
    const double share = height_mm / depth;
    return 2 * radius * math::cos(inclination.turn_rad) * std::sqrt(share * (2 - share));
}

double scallop_height_mm(const Cutter& cutter, Inclination inclination, double sidestep_mm) {
    const double radius = cutter.radius_mm(), corner = cutter.corner_radius_mm();
    if (!(sidestep_mm > 0)) return 0;
    const Outline outline(cutter, inclination);
    double low = 0, high = outline.full_height();
    if (outline.width(high) < sidestep_mm) return kInfinity;
    if (sidestep_mm <= effective_width_mm(cutter, inclination, outline.flank_height())) {
        if (corner == radius) return sagitta(radius, sidestep_mm);
        if (corner == 0)
            return radius * math::sin(inclination.tilt_rad) *
                   sagitta(1, sidestep_mm / (radius * math::cos(inclination.turn_rad)));
    }
    for (int i = 0; i < kBisections; ++i) {
        const double middle = 0.5 * (low + high);
        (outline.width(middle) >= sidestep_mm ? high : low) = middle;
    }
    return high;
}

}  // namespace tribo::milling
