// SPDX-License-Identifier: MIT
#pragma once

#include "field/shape/shape.hpp"

namespace tribo::field {

// An axis-aligned box: the usual blank. Its distance is the largest distance to its six planes, so that edges
// are sharp.
class BoxShape final : public Shape {
  public:
    explicit BoxShape(const Box3& box_mm) : box_(box_mm) {}
    Box3 bounds_mm() const override { return box_; }
    double distance_mm(Vec3 point_mm) const override;
    Vec3 gradient(Vec3 point_mm) const override;
    void sample(const Lattice& lattice, float* out) const override;

  private:
    Box3 box_;
};

}  // namespace tribo::field
