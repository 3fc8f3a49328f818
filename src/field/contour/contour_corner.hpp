// SPDX-License-Identifier: MIT
// The faces of the surface near a crossing: their tangents, and the corner in which two of them meet on a
// face of the grid.
#pragma once

#include <optional>

#include "base/vec3.hpp"
#include "field/carved/carved_field.hpp"

namespace tribo::field {

// Distance to the surface of one shape, and the direction out of the material that the shape bounds.
double distance_to_face(const CarvedField& field, ShapeId shape, Vec3 p);
Vec3 normal_of_face(const CarvedField& field, ShapeId shape, Vec3 p);

// A point of a face of the surface.
struct FacePoint {
    Vec3 point, normal;  // mm; unit, out of the material
    ShapeId shape = 0;
};

// Returns the plane that touches the face of `x` near p, which is at most some cells away. It is evaluated a
// share `back` of the way from p to x, so that this face of the shape answers, not the face that it meets at
// p.
FacePoint tangent_near(const CarvedField& field, const FacePoint& x, Vec3 p, double back);

// Goes from p along the normal to the surface, within `within_mm` of it. Nothing if that does not end.
std::optional<Vec3> on_surface(const CarvedField& field, Vec3 p, double within_mm);

// The surface crosses a face of the grid, whose normal is `axis`, from one point to another. Returns where it
// has its corner between them: in the cell with the lower corner `low`, at least off_mm within it. If the
// surface is smooth there, returns the middle.
Vec3 corner_on_face(const CarvedField& field, BrickRef ref, Vec3 from, Vec3 to, int axis, Vec3 low,
                    double off_mm);

}  // namespace tribo::field
