// SPDX-License-Identifier: MIT
// Circular moves of APT: the circle comes first, the end with the next GOTO.
#pragma once

#include <optional>

#include "readers/apt/path.hpp"

namespace tribo::readers::apt {

// In the program's frame.
struct Circle {
    Vec3 centre_mm, normal;  // turned about counter-clockwise seen from where the normal points
    double radius_mm = 0;
    std::optional<double> turn_rad;  // where the program states it
    double more_turns = 0;           // TIMES
    Item at;
};

// Spellings:
//   CIRCLE/x,y,z,i,j,k,r            ISO 4343, Creo; NX with tolerances behind
//   MOVARC/x,y,z,i,j,k,r,ANGLE,a    exporters of Autodesk, TIMES,n as well
//   MOVARC/CENTER,x,y,z,AXIS,i,j,k,RADIUS,r
Result<Circle> read_circle(const Statement& statement, Path& path, Report& report);

// Whether the tip may lie on the circle, or on a helix about its axis.
bool is_on(const Circle& circle, Vec3 tip_mm);

// The arc from where the tool is to `end`; a full turn where that is the same point. A turn that the program
// states decides on the direction where it is the other way round about the normal.
Result<motion::Arc> arc_to(const Circle& circle, Vec3 start_mm, Vec3 end_mm, const Item& at,
                           const Report& report);

// CATIA: TLON,GOFWD/(CIRCLE/x,y,z,r),ON,(LINE/x,y,z,xe,ye,ze), `forward` being the direction of INDIRV. The
// second point of the line is the end.
struct CatiaCircle {
    Circle circle;
    Vec3 end_mm;
};
Result<CatiaCircle> read_catia_circle(const Statement& statement, Vec3 forward, Path& path, Report& report);

}  // namespace tribo::readers::apt
