// SPDX-License-Identifier: MIT
// What a probe may ask of a surface, whoever made it: the stock while it is cut, a part that was read, a flat
// pad.
#pragma once

#include "base/vec3.hpp"

namespace tribo::contact {

// Distances in mm, negative inside material. Implementations answer in bounded time without allocation or
// locks, from any number of threads while nobody changes the field.
class DistanceField {
  public:
    virtual ~DistanceField() = default;
    // The zero set is the exact surface; off it the value is a lower bound of the distance with slope at
    // most 1.
    virtual double distance_mm(Vec3 point_mm) const = 0;
    // Unit direction of steepest increase (out of the material), at or near the surface.
    virtual Vec3 normal(Vec3 point_mm) const = 0;
};

}  // namespace tribo::contact
