// SPDX-License-Identifier: MIT
// Where a circle about the tool axis runs through material.
#pragma once

#include <vector>

#include "field/carved_view.hpp"
#include "milling/tool_frame.hpp"

namespace tribo::milling {

// A circle across the tool axis; its rotation is the tool frame's, clockwise from y seen from the shank.
struct AxisCircle {
    Vec3 centre_mm;
    Vec3 x, y;  // the frame's, times the radius
    double radius_mm = 0;

    Vec3 at(double rotation_rad) const;
};

// An interval of rotation, from < to; may lie beyond 2 pi.
struct MaterialArc {
    double from_rad = 0, to_rad = 0;
};

// A piece of the circle without material, and how far from its middle none is for sure.
struct ClearPiece {
    double middle_rad = 0, size_rad = 0, clear_mm = 0;
};

// Appends the arcs of `circle` between the rotations `from` and `to` that lie in material, in order. A step
// along the circle is as long as nothing can be missed, but at least a small share of the cell or of the
// range: a rib thinner than that may be missed. Borders are found to about 1e-9 rad.
// `clear` is filled with the pieces between, looked at in steps. No allocation while both have room.
void material_arcs(const field::CarvedView& stock, const AxisCircle& circle, double from, double to,
                   std::vector<MaterialArc>& arcs, std::vector<ClearPiece>& clear);

}  // namespace tribo::milling
