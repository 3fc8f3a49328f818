// SPDX-License-Identifier: MIT
// The point closest to a set of planes, as dual contouring places its vertices.
#pragma once

#include <array>

#include "base/vec3.hpp"

namespace tribo::field {

// Sum of squared distances to planes through points (Garland & Heckbert 1997), solved as in Ju, Losasso,
// Schaefer & Warren 2002: in the directions that the planes do not determine, the result stays at the mean of
// the points.
class Quadric {
  public:
    void add(Vec3 point, Vec3 unit_normal);
    int count() const { return count_; }
    Vec3 mean() const { return count_ > 0 ? sum_ / count_ : Vec3{}; }
    // A direction is undetermined if its share of the spread of the planes is below `cutoff` (0..1).
    Vec3 solve(double cutoff = 0.02) const { return solve_with({}, {}, cutoff); }
    // The same in a box: where the point of least distance is outside, a point on the side that it is beyond.
    Vec3 solve_in(const Box3& box, double cutoff = 0.02) const;
    // True if all normals are within about `tolerance` rad of one direction: the surface is smooth here.
    bool is_flat(double tolerance) const;

  private:
    // Solves for the coordinates that are not fixed; `offset` from the mean is that of the fixed ones.
    Vec3 solve_with(const std::array<bool, 3>& fixed, Vec3 offset, double cutoff) const;

    double xx_ = 0, xy_ = 0, xz_ = 0, yy_ = 0, yz_ = 0, zz_ = 0;  // sum of n n^T
    Vec3 right_;                                                  // sum of (n . p) n
    Vec3 sum_, normals_;
    int count_ = 0;
};

}  // namespace tribo::field
