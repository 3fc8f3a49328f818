// SPDX-License-Identifier: MIT
// The pressure of a contact on the nodes around it: the right side of the sheet's law (eq. 3). It is a number
// in newton that the sheet converts to a displacement by its stiffness, negative into the image. Touch paper,
// section 2.1. Its equations 1 and 2 are available as printed; the default keeps their shape and corrects
// them. Any thread, no allocation.
#pragma once

#include "elastic/contact_ellipse.hpp"

namespace tribo::elastic {

enum class ContactShape {
    area,   // two zones: under the contact and around it
    point,  // the single point of the original elastic images
};

// Default
// ----------------------------------------------------------------------------------------------------

// A contact reaches this many of its half axes. Beyond it the pressure is exactly 0.
inline constexpr double kReach = 6;
// Relative decrease of the pressure from the centre of the contact to its edge.
inline constexpr double kEdgeDrop = 0.2;

// The share of the contact's force that acts at `rho` half axes from its centre: 1 at the centre, falling, 0
// from kReach on. Value and slope are continuous (`point`: except at the tip). Under the contact it follows
// eq. 1, 1 - d (e^(5 (rho - 1)) - e^-5) / (1 - e^-5) with d the edge drop. Around it, it follows eq. 2, an
// exponential with the length that makes the slope continuous. Both are multiplied by a window that ends
// them. Here in the form of the kernels, with w = 1 - rho^2 / kReach^2: w^2 (inner_base + inner 2^(inner_rate
// (rho - origin))) up to `edge`, beyond it w^2 outer 2^(outer_rate (rho - origin)) = w^2 outer_from_centre
// 2^(outer_rate rho). The smaller one of both exponents applies.
struct ShareLaw {
    float edge = 0, origin = 0;
    float inner_base = 0, inner = 0, inner_rate = 0;
    float outer = 0, outer_rate = 0, outer_from_centre = 0;
};
ShareLaw share_law(ContactShape shape);

// As published
// -----------------------------------------------------------------------------------------------

// End of the model, in radii of the contact (figure 3: R_max 10, R_th 0.25).
inline constexpr double kPublishedReach = 40;

// Returns equations 1 and 2 at `distance_mm` from the centre of a round contact of `radius_mm` that has
// lasted `held_s`; the size of the force is ignored. Eq. 2 is 0 outside of the contact at t = 0, and 0 beyond
// the reach. `point`: the limit of eq. 2 for a radius of 0, -exp(-5 d / (R_max t)) t.
double published_pressure(ContactShape shape, double distance_mm, double held_s, double radius_mm);

}  // namespace tribo::elastic
