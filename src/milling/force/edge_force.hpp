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

// Half of the span of such a piece, 0 or more, and the sinc factor q of it.
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

}  // namespace tribo::milling
