// SPDX-License-Identifier: MIT
// The force of one piece of cutting edge in closed form, without a singularity at helix 0.
//
// Frame and signs (docs/results.md): x along the feed, y to its left, z to the shank; the
// rotation phi runs clockwise seen from the shank, from the y axis. At phi an edge moves along (cos, -sin)
// and points outward along (sin, cos). Torque is what the spindle must give, positive against a cut. The
// axial coefficients act along the meridian towards the tip (Lee and Altintas 1996: dFz = cos kappa dFr - sin
// kappa dFa): with positive kac a right-hand helix pulls the tool out of its holder.
//
// All functions: any thread, real-time safe (no allocation, locks or throws).
#pragma once

#include "contact/force_spectrum.hpp"
#include "milling/tool/coefficients.hpp"

namespace tribo::milling {

// How a cutter travels over some time: between one tooth and the next, or along a row. A rigid motion: at the
// height z above the tip the axis goes (across + z turn_x) along x and z turn_y along y, and a point at the
// rotation phi and the radius r goes down by down + r (turn_x sin phi + turn_y cos phi).
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

// A place on the cutter's envelope. kappa is the angle between its outward normal and the direction from the
// shank to the tip: pi/2 on the cylinder, 0 at the tip of a ball and on a flat bottom.
struct ProfilePoint {
    double radius_mm = 0, height_mm = 0;
    double sin_kappa = 1, cos_kappa = 0;
};

// A quantity of one place on the envelope over the rotation phi: sine sin phi + cosine cos phi + constant.
struct TurnLaw {
    double sine = 0, cosine = 0, constant = 0;
};

// Rotations from < to, `from` in the first turn; from == to: none.
struct TurnWindow {
    double from_rad = 0, to_rad = 0;

    bool empty() const { return !(to_rad > from_rad); }
};
// Where the law is above `least`.
TurnWindow window_above(const TurnLaw& law, double least);

// How far the place moves along the outward normal, mm: the chip thickness where it is above 0.
TurnLaw normal_travel(const ToolTravel& travel, const ProfilePoint& at);

// The chip that an edge meets: the tool's travel since the edge before, and how much further out this edge
// stands than that one (run-out), mm.
struct Chip {
    ToolTravel travel;
    double offset_mm = 0;

    bool operator==(const Chip&) const = default;
};
TurnLaw thickness(const Chip& chip, const ProfilePoint& at);

// Force of an edge per mm, N/mm, and torque per mm, N, over the rotation: tangential t, in-plane radial r
// (inward), axial a (to the shank), moment m.
struct EdgeLoad {
    TurnLaw t, r, a, m;
};

// The load per mm of the envelope's profile (db = dz / sin kappa).
EdgeLoad edge_load(const CuttingCoefficients& k, const Chip& chip, const ProfilePoint& at);

// The load of a radial edge on the flat bottom from r0 to r1, N and N mm: krc to the shank, kac outward along
// the edge, whose leading end is the corner.
EdgeLoad bottom_load(const CuttingCoefficients& k, const ToolTravel& travel, double r0_mm, double r1_mm);

// The load at one rotation, N/mm and N.
contact::ToolForce force_at_rotation(const EdgeLoad& load, double sin_phi, double cos_phi);

// Force on the tool, N, and torque, N mm, of a piece of edge `height_mm` long whose rotation runs evenly from
// phi_low (upper end: the helix lags) to phi_high >= phi_low. Altintas 2012, equation 2.93 and on, rewritten
// with sinc factors: with m the middle and d the span of phi, s = sin d / d, q = sin(d/2) / (d/2), every
// integral is height times a bounded term.
contact::ToolForce segment_force(const EdgeLoad& load, double phi_low, double phi_high, double height_mm);

// The same on the cylinder for coefficients and a feed per tooth.
contact::ToolForce flute_segment_force(const CuttingCoefficients& k, double radius_mm,
                                       double feed_per_tooth_mm, double phi_low, double phi_high,
                                       double height_mm);

}  // namespace tribo::milling
