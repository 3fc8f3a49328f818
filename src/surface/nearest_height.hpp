// SPDX-License-Identifier: MIT
// Distance of the machined part from a point of the designed surface, measured to the nearest point of the
// design.
#pragma once

#include <optional>

#include "contact/distance_field.hpp"
#include "field/shape/shape.hpp"
#include "surface/designed_surface.hpp"

namespace tribo::surface {

// Refers to its arguments. Any thread; allocates nothing.
//
// The search follows the line along the normal to the place where the machined material ends (rest) or begins
// (gouge). Each point on this way lies in material that should be removed, or in a gap that should be
// material. The result is the largest distance of such a point to the design. Over a smooth surface this is
// the length of the way. Near an edge and in a thin wall it is less: beyond the middle of a wall the nearest
// point is on its other side. A missing rib 2 mm thick and 30 mm high is a gouge of 1 mm from all its faces.
// The balls that touch the design at the point and contain no other part of it are found by shrinking (Ma,
// Bae and Choi 2012).
class NearestHeight {
  public:
    // `limit_mm`: longest way of the search. `blank`, if known: the space outside it was never material and
    // therefore is not gouged.
    NearestHeight(const contact::DistanceField& machined, const DesignedSurface& designed, double limit_mm,
                  const field::Shape* blank)
        : machined_(machined), designed_(designed), limit_(limit_mm), blank_(blank) {}

    // + material left, - gouge, mm. Returns nothing if the point is outside the blank without material over
    // it, or if neither a border of the material nor another part of the design is found within limit_mm.
    // Cost: height_over, and one or a few closest points of the design if the height is over 0.1 um.
    std::optional<double> at(Vec3 point_mm, Vec3 normal, std::uint32_t triangle) const;

    // The same with the length of the way, signed; limit_mm where no border was found.
    struct Height {
        double mm = 0, way_mm = 0;
    };
    std::optional<Height> with_way(Vec3 point_mm, Vec3 normal, std::uint32_t triangle) const;

  private:
    struct Way {
        double mm;     // signed
        bool is_open;  // no border was found
    };
    std::optional<Way> way(Vec3 point_mm, Vec3 normal) const;
    std::optional<double> height(const Way& found, Vec3 point_mm, Vec3 normal, std::uint32_t triangle) const;

    const contact::DistanceField& machined_;
    const DesignedSurface& designed_;
    double limit_;
    const field::Shape* blank_;
};

}  // namespace tribo::surface
