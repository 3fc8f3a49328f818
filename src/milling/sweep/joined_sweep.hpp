// SPDX-License-Identifier: MIT
// The volume that a cutter sweeps along several moves, one after the other, as one shape.
#pragma once

#include <memory>
#include <vector>

#include "field/shape/shape.hpp"

namespace tribo::milling {

// The union of sweeps of any kind, at least one.
class JoinedSweep : public field::Shape {
  public:
    explicit JoinedSweep(std::vector<std::unique_ptr<const field::Shape>> parts);

    Box3 bounds_mm() const override { return box_; }
    double distance_mm(Vec3 point_mm) const override;
    double distance_below(Vec3 point_mm, double bound_mm) const override;
    bool is_searched() const override;
    Vec3 gradient(Vec3 point_mm) const override;
    Slope slope(Vec3 point_mm) const override;
    void sample(const field::Lattice& lattice, float* out) const override;
    void sample_near(const field::Lattice& lattice, double near_mm, float* out) const override;
    void sample_below(const field::Lattice& lattice, double near_mm, const float* known,
                      float* out) const override;

  protected:
    struct Least {
        double distance;
        std::size_t part;
    };
    // Returns the part that is nearest to a point in reach, if its distance is below the one of `least`, else
    // `least`.
    virtual Least nearest_part(Vec3 point_mm, Least least) const;
    // Returns the part to begin with at a point.
    virtual std::size_t likely_part(Vec3 /*point_mm*/) const { return 0; }
    const std::vector<std::unique_ptr<const field::Shape>>& parts() const { return parts_; }

  private:
    Least least(Vec3 point_mm, double bound_mm) const;

    std::vector<std::unique_ptr<const field::Shape>> parts_;
    Box3 box_;
};

}  // namespace tribo::milling
