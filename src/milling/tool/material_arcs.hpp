// SPDX-License-Identifier: MIT
// The arcs of a circle about the tool axis that lie in material.
#pragma once

#include <vector>

#include "base/math.hpp"
#include "field/carved/carved_view.hpp"
#include "milling/tool/tool_frame.hpp"

namespace tribo::milling {

// Material thinner than this in front of the edge is ignored: it is rounding, left where the cutter runs
// along a surface that it made before.
inline constexpr double kSkin = 2e-5;  // mm

// Number of even places on a whole turn of a circle that are tested. The first is at rotation 0.
inline constexpr int kTurnPlaces = 128;
inline constexpr double kPlaceRad = math::kTwoPi / kTurnPlaces;

// A circle across the tool axis. Its rotation is that of the tool frame: clockwise seen from the shank, from
// y.
struct AxisCircle {
    Vec3 centre_mm;
    Vec3 x, y;  // axes of the frame times the radius
    double radius_mm = 0;

    Vec3 at(double rotation_rad) const;
    Vec3 at_place(int place) const;  // one of kTurnPlaces, also beyond a turn
};

// An interval of rotation, from < to; may lie beyond 2 pi.
struct MaterialArc {
    double from_rad = 0, to_rad = 0;
};

// Appends the arcs of `circle` between the rotations `from` and `to` that lie in material, in order. The
// circle is tested at kTurnPlaces or more, at most 1 mm and one cell apart, and at both ends, except where no
// border can lie. A rib thinner than the distance between two places may be missed. Borders are accurate to
// about 1e-7 rad. The result depends on the material alone, not on the storage of the stock. No allocation
// while `arcs` has capacity.
void material_arcs(const field::CarvedView& stock, const AxisCircle& circle, double from, double to,
                   std::vector<MaterialArc>& arcs);

}  // namespace tribo::milling
