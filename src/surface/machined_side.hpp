// SPDX-License-Identifier: MIT
// The points of the machined surface that are farthest from the design, searched from the machined side.
#pragma once

#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "contact/distance_field.hpp"
#include "field/shape/shape.hpp"
#include "surface/designed_surface.hpp"

namespace tribo::surface {

struct DeviationExtreme {
    double mm = 0;     // >= 0; 0: none
    Vec3 at_mm;        // on the designed surface
    Vec3 machined_mm;  // on the machined one
};

struct MachinedExtremes {
    DeviationExtreme gouge, rest;
    // The signed distance of each point to the design: + outside it. 0 where it has no meaning.
    std::vector<double> deviations_mm;
};

// Finds the largest distances of the machined surface to the nearest point of the design, outside it (rest)
// and inside it (gouge). It climbs from the farthest of `points_mm`, which lie on the machined surface. It
// finds places to which no normal of the design points: a corner of the blank that was left, material beyond
// an edge. It leaves out points beyond the border of an open design, where sides have no meaning; the faces
// of the blank as gouges; and everything if triangles of an open design are turned over. The bits do not
// depend on `parallel`.
MachinedExtremes farthest_machined(const contact::DistanceField& machined, const DesignedSurface& designed,
                                   const field::Shape* blank, std::span<const Vec3> points_mm,
                                   double spacing_mm, const ParallelFor& parallel);

}  // namespace tribo::surface
