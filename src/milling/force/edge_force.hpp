// SPDX-License-Identifier: MIT
// The force of one piece of cutting edge in closed form, without a singularity at helix 0.
//
// Frame and signs (docs/results.md): x along the feed, y to its left, z to the shank. The rotation phi runs
// clockwise seen from the shank, from the y axis. At phi an edge moves along (cos, -sin) and points outward
// along (sin, cos). The torque is the torque of the spindle, positive against a cut. The axial coefficients
// act along the meridian towards the tip (Lee and Altintas 1996: dFz = cos kappa dFr - sin kappa dFa): with
// positive kac a right-hand helix pulls the tool out of its holder.
//
// All functions: any thread, real-time safe (no allocation, locks or throws).
#pragma once

#include "contact/force_spectrum.hpp"
#include "milling/tool/coefficients.hpp"

namespace tribo::milling {

// Travel of a cutter over some time, for example from one tooth to the next or along a row. It is a rigid
// motion: at the height z above the tip the axis moves by across + z turn_x along x and by z turn_y along y.
// A point at the rotation phi and the radius r moves down by down + r (turn_x sin phi + turn_y cos phi).
struct ToolTravel {
    double across_mm = 0;                   // of the tip across the axis, along x; >= 0
    double down_mm = 0;                     // of the tip along the axis, away from the shank: > 0 in a plunge
    double turn_x_rad = 0, turn_y_rad = 0;  // change of the unit axis along x and y

    bool turns() const { return turn_x_rad != 0 || turn_y_rad != 0; }
    bool operator==(const ToolTravel&) const = default;
    friend ToolTravel operator*(double s, const ToolTravel& t) {
        return {s * t.across_mm, s * t.down_mm, s * t.turn_x_rad, s * t.turn_y_rad};
    }
};

// A point of the profile of the cutter's envelope. kappa is the angle between its outward normal and the
// direction from the shank to the tip: pi/2 on the cylinder, 0 at the tip of a ball and on a flat bottom.
struct ProfilePoint {
    double radius_mm = 0, height_mm = 0;
    double sin_kappa = 1, cos_kappa = 0;
};

// A quantity at one point of the profile as a function of the rotation phi: sine sin phi + cosine cos phi +
// constant.
struct TurnLaw {
    double sine = 0, cosine = 0, constant = 0;
};

// The rotations from `from_rad` to `to_rad`; `from_rad` lies in the first turn. Empty if both are equal.
struct TurnWindow {
    double from_rad = 0, to_rad = 0;

    bool empty() const { return !(to_rad > from_rad); }
};
// Returns the rotations at which the law is above `least`.
TurnWindow window_above(const TurnLaw& law, double least);

// Returns the travel of the point along the outward normal, mm. Where it is positive, it is the chip
// thickness.
TurnLaw normal_travel(const ToolTravel& travel, const ProfilePoint& at);

// The chip of an edge: the travel of the tool since the edge before, and the distance by which this edge
// stands further out than that one (run-out), mm.
struct Chip {
    ToolTravel travel;
    double offset_mm = 0;

    bool operator==(const Chip&) const = default;
};
TurnLaw thickness(const Chip& chip, const ProfilePoint& at);

// Force of an edge per mm, N/mm, and torque per mm, N, as functions of the rotation: tangential t, in-plane
// radial r (inward), axial a (to the shank), torque m.
struct EdgeLoad {
    TurnLaw t, r, a, m;
};

// Returns the load per mm of the profile of the envelope (db = dz / sin kappa), of a chip or of its
// thickness.
EdgeLoad edge_load(const CuttingCoefficients& k, const Chip& chip, const ProfilePoint& at);
EdgeLoad edge_load(const CuttingCoefficients& k, const TurnLaw& thickness, const ProfilePoint& at);

// Returns the load of a radial edge on the flat bottom from r0 to r1, N and N mm. krc acts to the shank; kac
// acts outward along the edge, because the corner is its leading end.
EdgeLoad bottom_load(const CuttingCoefficients& k, const ToolTravel& travel, double r0_mm, double r1_mm);

// Returns the load at one rotation, N/mm and N.
contact::ToolForce force_at_rotation(const EdgeLoad& load, double sin_phi, double cos_phi);

// Returns the force on the tool, N, and the torque, N mm, of a piece of edge `height_mm` long. Its rotation
// runs evenly from phi_low (upper end: the helix lags) to phi_high >= phi_low. Altintas 2012, equation 2.93
// and following, rewritten with sinc factors: with m the middle and d the span of phi, s = sin d / d, q =
// sin(d/2) / (d/2), every integral is the height times a bounded term.
contact::ToolForce segment_force(const EdgeLoad& load, double phi_low, double phi_high, double height_mm);

// Half of the span of such a piece, and the sinc factor q of it; also sine and cosine of any angle, most
// cheaply of a small one.
struct HalfSpan {
    double sine = 0, cosine = 1, sinc = 1;
};
HalfSpan half_span(double angle_rad);
// The same force by sine and cosine of the middle of the piece.
contact::ToolForce segment_force(const EdgeLoad& load, double sin_mid, double cos_mid, const HalfSpan& half,
                                 double height_mm);

// The same for a piece on the cylinder, from coefficients and a feed per tooth.
contact::ToolForce flute_segment_force(const CuttingCoefficients& k, double radius_mm,
                                       double feed_per_tooth_mm, double phi_low, double phi_high,
                                       double height_mm);

// In the header: a vibration calls them for each piece and sample, and uses the force alone.
inline EdgeLoad edge_load(const CuttingCoefficients& k, const TurnLaw& h, const ProfilePoint& at) {
    const auto law = [&](double shear, double edge) {
        return TurnLaw{shear * h.sine, shear * h.cosine, shear * h.constant + edge};
    };
    const double s = at.sin_kappa, c = at.cos_kappa, radius = at.radius_mm;
    return {.t = law(k.ktc, k.kte),
            .r = law(k.krc * s + k.kac * c, k.kre * s + k.kae * c),
            .a = law(k.krc * c - k.kac * s, k.kre * c - k.kae * s),
            .m = law(radius * k.ktc, radius * k.kte)};
}

inline contact::ToolForce force_at_rotation(const EdgeLoad& load, double sin_phi, double cos_phi) {
    const auto at = [&](const TurnLaw& law) {
        return law.sine * sin_phi + law.cosine * cos_phi + law.constant;
    };
    const double t = at(load.t), r = at(load.r);
    return {{-t * cos_phi - r * sin_phi, t * sin_phi - r * cos_phi, at(load.a)}, at(load.m)};
}

inline contact::ToolForce segment_force(const EdgeLoad& load, double sin_mid, double cos_mid,
                                        const HalfSpan& half, double height_mm) {
    const double q = half.sinc, s = q * half.cosine;  // sin(d/2) / (d/2), sin d / d
    // Means of sin, cos, sin cos, sin^2 and cos^2 over the piece.
    const double sine = q * sin_mid, cosine = q * cos_mid, sin_cos = s * sin_mid * cos_mid;
    const double sin2 = 0.5 * (1 - s * (1 - 2 * sin_mid * sin_mid)), cos2 = 1 - sin2;
    const TurnLaw &t = load.t, &r = load.r;
    const double b = height_mm;
    return {{-b * (t.sine * sin_cos + t.cosine * cos2 + t.constant * cosine + r.sine * sin2 +
                   r.cosine * sin_cos + r.constant * sine),
             b * (t.sine * sin2 + t.cosine * sin_cos + t.constant * sine - r.sine * sin_cos -
                  r.cosine * cos2 - r.constant * cosine),
             b * (load.a.sine * sine + load.a.cosine * cosine + load.a.constant)},
            b * (load.m.sine * sine + load.m.cosine * cosine + load.m.constant)};
}

}  // namespace tribo::milling
