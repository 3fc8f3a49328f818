// SPDX-License-Identifier: MIT
// Where the machined surface is farthest from the design, looked at from the machined side.
#pragma once

#include <span>

#include "base/parallel.hpp"
#include "contact/distance_field.hpp"
#include "field/shape/shape.hpp"
#include "surface/designed_surface.hpp"

namespace tribo::surface {

struct DeviationExtreme {
    double mm = 0;  // >= 0; 0: none
    Vec3 at_mm;     // on the designed surface
};

struct MachinedExtremes {
    DeviationExtreme gouge, rest;
};

// The largest distances of the machined surface to the nearest point of the design, outside it (rest) and
// inside it (gouge), climbed to from the farthest of `points_mm`, which lie on the machined surface. Sees
// what no normal of the design points to: the corner of a blank that was left, material beyond an edge. Left
// out: points beyond the border of an open design, where sides mean nothing; the blank's own faces as gouges;
// everything where triangles of an open design are turned over. Same bits whatever `parallel` does.
MachinedExtremes farthest_machined(const contact::DistanceField& machined, const DesignedSurface& designed,
                                   const field::Shape* blank, std::span<const Vec3> points_mm,
                                   double spacing_mm, const ParallelFor& parallel);

}  // namespace tribo::surface
