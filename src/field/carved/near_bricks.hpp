// SPDX-License-Identifier: MIT
// The bricks around a point, the nearest one first.
#pragma once

#include <array>

#include "field/carved/field_query.hpp"

namespace tribo::field {

// The bricks within `bound_mm` of a point, which is in the brick `here`, that may contain material: the
// nearest ones if there are too many, and at most 6 on each side.
class NearBricks {
  public:
    NearBricks(const FieldQuery& field, BrickCoord here, Vec3 point_mm, double bound_mm);
    // Takes the nearest brick that was not taken yet, if there is one within `bound_mm`.
    bool take(double bound_mm, BrickCoord& brick, double& distance_mm);
    // All bricks up to this distance are listed.
    double seen_mm() const { return seen_mm_; }

  private:
    struct One {
        double square;
        BrickCoord brick;
    };
    void put(const One& one);

    std::array<One, 192> all_;
    std::size_t count_ = 0;
    double seen_mm_ = 0;
};

}  // namespace tribo::field
