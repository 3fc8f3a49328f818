// SPDX-License-Identifier: MIT
// How far the machined part stands off a point of the designed surface, counted to the nearest point of the
// design.
#pragma once

#include <optional>

#include "contact/distance_field.hpp"
#include "field/shape/shape.hpp"
#include "surface/designed_surface.hpp"

namespace tribo::surface {

// Refers to what it is given. Any thread; allocates nothing.
//
// The line along the normal is walked to where the machined material ends (rest) or begins (gouge). Each
// point on the way lies in material that should be gone, or in a gap that should be material; the answer is
// the largest distance of such a point to the design. Over a smooth surface that is the length of the way.
// Near an edge and in a thin wall it is less: beyond the middle of a wall the nearest point is on its other
// side. A missing rib 2 mm thick and 30 mm high is a gouge of 1 mm, whichever of its faces is asked. The
// balls that touch the design at the point and hold no other part of it are found by shrinking (Ma, Bae and
// Choi 2012).
class NearestHeight {
  public:
    // `limit_mm`: longest way that is walked. `blank`, where it is known: what lies outside it was never
    // material, so it is not gouged.
    NearestHeight(const contact::DistanceField& machined, const DesignedSurface& designed, double limit_mm,
                  const field::Shape* blank)
        : machined_(machined), designed_(designed), limit_(limit_mm), blank_(blank) {}

    // + material left, - gouge, mm. None where the point is outside the blank and no material is over it, and
    // where neither a border of the material nor another part of the design is met within limit_mm.
    // Cost: height_over, and one to some closest points of the design where the height is over 0.1 um.
    std::optional<double> at(Vec3 point_mm, Vec3 normal, std::uint32_t triangle) const;

  private:
    struct Way {
        double mm;     // signed
        bool is_open;  // no border was met
    };
    std::optional<Way> way(Vec3 point_mm, Vec3 normal) const;

    const contact::DistanceField& machined_;
    const DesignedSurface& designed_;
    double limit_;
    const field::Shape* blank_;
};

}  // namespace tribo::surface
