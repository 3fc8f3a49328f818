// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "field/shape/shape.hpp"
#include "motion/machine/work_frame.hpp"

namespace tribo::job {

// A solid in the coordinates of a frame: the blank in the next set-up. Distances are those of the solid at
// the transformed point.
class TurnedShape final : public field::Shape {
  public:
    // `bounds_mm` contains the turned solid.
    TurnedShape(std::unique_ptr<const field::Shape> solid, const motion::WorkFrame& frame,
                const Box3& bounds_mm);

    Box3 bounds_mm() const override { return bounds_; }
    double distance_mm(Vec3 p) const override { return solid_->distance_mm(frame_.in_stock(p)); }
    double distance_below(Vec3 p, double bound_mm) const override {
        return solid_->distance_below(frame_.in_stock(p), bound_mm);
    }
    bool is_searched() const override { return solid_->is_searched(); }
    Vec3 gradient(Vec3 p) const override {
        return frame_.direction_from_stock(solid_->gradient(frame_.in_stock(p)));
    }
    void sample(const field::Lattice& lattice, float* out) const override;

  private:
    std::unique_ptr<const field::Shape> solid_;
    motion::WorkFrame frame_;
    Box3 bounds_;
};

}  // namespace tribo::job
