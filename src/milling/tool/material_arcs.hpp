// SPDX-License-Identifier: MIT
// Where a circle about the tool axis runs through material.
#pragma once

#include <vector>

#include "base/math.hpp"
#include "field/carved/carved_view.hpp"
#include "milling/tool/tool_frame.hpp"

namespace tribo::milling {

// Material thinner than this in front of the edge is what rounding leaves where the cutter runs along a
// surface that it has made before.
inline constexpr double kSkin = 2e-5;  // mm

// Places on a whole turn at which a circle is looked at, the first at rotation 0.
inline constexpr int kTurnPlaces = 128;
inline constexpr double kPlaceRad = math::kTwoPi / kTurnPlaces;

// A circle across the tool axis; its rotation is the tool frame's, clockwise from y seen from the shank.
struct AxisCircle {
    Vec3 centre_mm;
    Vec3 x, y;  // the frame's, times the radius
    double radius_mm = 0;

    Vec3 at(double rotation_rad) const;
    Vec3 at_place(int place) const;  // of kTurnPlaces, also beyond a turn
};

// An interval of rotation, from < to; may lie beyond 2 pi.
struct MaterialArc {
    double from_rad = 0, to_rad = 0;
};

// Appends the arcs of `circle` between the rotations `from` and `to` that lie in material, in order. The
// circle is known at kTurnPlaces and at both ends, and wherever nothing can hide: a rib thinner than the way
// between two places may be missed. Borders are found to about 1e-7 rad. What comes out depends on the
// material alone, not on how the stock keeps it. No allocation while `arcs` has room.
void material_arcs(const field::CarvedView& stock, const AxisCircle& circle, double from, double to,
                   std::vector<MaterialArc>& arcs);

}  // namespace tribo::milling
