// SPDX-License-Identifier: MIT
// Cutting coefficients of a material: force per chip area and per edge length, given or derived from
// orthogonal cutting.
#pragma once

#include "base/result.hpp"

namespace tribo::milling {

// Forces on the tool per mm of edge height at chip thickness h: tangential ktc h + kte against the motion,
// radial krc h + kre along the inward normal of the envelope, axial kac h + kae along the edge towards its
// leading end (docs/force.md). On a right-hand helix this end is the tip.
struct CuttingCoefficients {
    double ktc = 0, krc = 0, kac = 0;  // shear, N/mm2
    double kte = 0, kre = 0, kae = 0;  // edge (ploughing), N/mm
};

// Refuses values out of their range (base/limits.hpp): ktc is above 0, kte not below; radial and axial values
// may be negative, because sharp positive edges pull.
Result<void> check(const CuttingCoefficients& coefficients);

// Orthogonal cutting of one material. Chip ratio r = r0 h^a with h in mm; r0, a and the friction angle are
// linear in the rake angle (the form of Budak, Altintas, Armarego 1996).
struct OrthogonalData {
    double shear_stress_n_per_mm2 = 0;
    double ratio = 1, ratio_per_deg = 0;                // r0 = ratio + ratio_per_deg * rake
    double exponent = 0, exponent_per_deg = 0;          // a
    double friction_deg = 0, friction_deg_per_deg = 0;  // friction angle
    double kte = 0, kre = 0, kae = 0;                   // N/mm, not transformed
};

// Computes ktc, krc, kac at chip thickness h by the oblique transformation, with the chip flow angle equal to
// the inclination (Stabler's rule; Armarego and Brown 1969, Budak, Altintas, Armarego 1996). For a helical
// end mill the inclination is the helix angle. h > 0, |rake| and inclination in (-pi/2, pi/2).
CuttingCoefficients oblique_coefficients(const OrthogonalData& data, double rake_rad, double inclination_rad,
                                         double chip_mm);

}  // namespace tribo::milling
