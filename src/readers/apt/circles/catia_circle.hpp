// SPDX-License-Identifier: MIT
// Circles as an APT processor writes them: the tool goes forward (TLON,GOFWD) along a circle or a cylinder to
// a line, a plane or a point. CATIA and NCL write them, and Creo with APT_FORMAT.
#pragma once

#include <optional>

#include "readers/apt/circles/circle.hpp"
#include "readers/apt/path.hpp"

namespace tribo::readers::apt {

struct CatiaCircle {
    Circle circle;
    Vec3 end_mm;
};

// Spellings, with or without brackets and CANON:
//   (CIRCLE/x,y,z,r), (CIRCLE/x,y,z,i,j,k,r), (CYLNDR/x,y,z,i,j,k,r), then ON or ON,n,INTOF, then
//   (LINE/x,y,z,xe,ye,ze)   the end is the second point
//   (PLANE/i,j,k,d)         the end is the n-th point in the plane (1 if absent)
//   (POINT/x,y,z)           the end
// `forward`: of INDIRV. `surface`: the normal of PSIS. Both in the frame of the program. A circle without an
// axis stands square on the surface, else on the tool axis, else in the plane of its start and `forward`.
Result<CatiaCircle> read_catia_circle(const Statement& statement, Vec3 forward,
                                      const std::optional<Vec3>& surface, const Path& path, Report& report);

// Reads PSIS/(PLANE/i,j,k,d). Returns the normal, as written.
Result<Vec3> read_plane_normal(const Statement& statement, const Path& path, Report& report);

}  // namespace tribo::readers::apt
