// SPDX-License-Identifier: MIT
// Circular moves of APT. A statement gives the circle, the next GOTO its end.
#pragma once

#include <optional>

#include "readers/apt/path.hpp"

namespace tribo::readers::apt {

// Largest distance of a point from its circle, mm: the rounding of coordinates and radius in inches with
// three decimals. A circle has a larger radius.
inline constexpr double kOnCircleMm = 0.02;

// In the frame of the program.
struct Circle {
    Vec3 centre_mm, normal;  // the arc turns counter-clockwise, seen from the tip of the normal
    double radius_mm = 0;
    std::optional<double> turn_rad;  // absent: the program does not state it
    double more_turns = 0;           // TIMES
    Item at;
};

// Spellings:
//   CIRCLE/x,y,z,i,j,k,r            ISO 4343, Creo
//   CIRCLE/x,y,z,i,j,k,r,t,f,d,e    NX: the arc turns clockwise, seen from the tip of i,j,k
//   CIRCLE/x,y,z,i,j,k              SOLIDWORKS CAM: through the place of the tool
//   MOVARC/x,y,z,i,j,k,r,ANGLE,a    exporters of Autodesk; may have TIMES,n
//   MOVARC/CENTER,x,y,z,AXIS,i,j,k,RADIUS,r
Result<Circle> read_circle(const Statement& statement, Path& path, Report& report);

// True when the tip lies on the circle, or on a helix about its axis.
bool is_on(const Circle& circle, Vec3 tip_mm);

// Returns the arc from `start_mm` to `end_mm`, a full turn if both are the same point. If the turn that the
// program states agrees only with the opposite direction about the normal, the arc takes that direction.
Result<motion::Arc> arc_to(const Circle& circle, Vec3 start_mm, Vec3 end_mm, const Item& at,
                           const Report& report);

}  // namespace tribo::readers::apt
