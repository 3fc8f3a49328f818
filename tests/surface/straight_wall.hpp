// SPDX-License-Identifier: MIT
// A wall whose material ends at y = 0 and lies beyond.
#pragma once

#include "contact/distance_field.hpp"

namespace tribo::test {

class StraightWall final : public contact::DistanceField {
  public:
    double distance_mm(Vec3 p) const override { return -p.y; }
    Vec3 normal(Vec3) const override { return {0, -1, 0}; }
};

}  // namespace tribo::test
