// SPDX-License-Identifier: MIT
// The force of one piece of cutting edge in closed form, without a singularity at helix 0.
//
// Frame and signs (docs/results.md): x along the feed, y to its left, z to the shank; the
// rotation phi runs clockwise seen from the shank, from the y axis. At phi an edge moves along (cos, -sin)
// and points outward along (sin, cos). Torque is what the spindle must give, positive against a cut.
//
// All functions: any thread, real-time safe (no allocation, locks or throws).
#pragma once

#include "contact/force_spectrum.hpp"
#include "milling/coefficients.hpp"

namespace tribo::milling {

// Chip thickness along the envelope's outward normal, mm, for the envelope's angle kappa (pi/2 on the
// cylinder, 0 at the tip of a ball) and rotation phi: h = (across sin phi + offset) sin kappa + down cos
// kappa. This is the tool's travel since the edge before, dotted with the normal: moving down adds.
struct Chip {
    double across_mm = 0;  // feed per tooth across the axis
    double offset_mm = 0;  // how much further out this edge stands than the one before (run-out)
    double down_mm = 0;    // feed per tooth along the axis, towards the tip

    bool operator==(const Chip&) const = default;
};

// Force of an edge per mm, N/mm, and torque per mm, N, as a function of the rotation: tangential t, in-plane
// radial r (inward), axial a (to the shank), moment m; each is `sine * sin phi + constant`.
struct EdgeLoad {
    double t_sine = 0, r_sine = 0, a_sine = 0, m_sine = 0;
    double t = 0, r = 0, a = 0, m = 0;
};

// The load per mm of the envelope's profile (db = dz / sin kappa) at radius `radius_mm`.
EdgeLoad edge_load(const CuttingCoefficients& k, const Chip& chip, double sin_kappa, double cos_kappa,
                   double radius_mm);

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
