// SPDX-License-Identifier: MIT
// Shapes with closed forms for the tests of the field: nothing of the product's sweeps is used to check the
// field.
#pragma once

#include <algorithm>
#include <cmath>

#include "field/shape/shape.hpp"

namespace tribo::field::test {

// Samples node by node.
class PlainShape : public Shape {
  public:
    void sample(const Lattice& lattice, float* out) const override {
        for (int c = 0; c < kLatticeEdge; ++c) {
            for (int b = 0; b < kLatticeEdge; ++b) {
                for (int a = 0; a < kLatticeEdge; ++a) {
                    *out++ = static_cast<float>(distance_mm(lattice.node(a, b, c)));
                }
            }
        }
    }
};

// All points within `radius` of the segment from a to b, and above it: a ball cutter's straight pass.
class BallPass final : public PlainShape {
  public:
    BallPass(Vec3 a, Vec3 b, double radius) : a_(a), b_(b), r_(radius) {}
    Box3 bounds_mm() const override {
        Box3 box;
        box.include(a_);
        box.include(b_);
        box = box.inflated(r_);
        box.max.z = 1e3;
        return box;
    }
    double distance_mm(Vec3 p) const override { return length(offset(p)) - r_; }
    Vec3 gradient(Vec3 p) const override { return normalized(offset(p)); }

  private:
    Vec3 offset(Vec3 p) const {
        const Vec3 e = b_ - a_;
        const double t = std::clamp(dot(p - a_, e) / squared_length(e), 0.0, 1.0);
        Vec3 d = p - (a_ + t * e);
        d.z = std::min(d.z, 0.0);
        return d;
    }
    Vec3 a_, b_;
    double r_;
};

// Everything above a plane.
class HalfSpace final : public PlainShape {
  public:
    HalfSpace(Vec3 point, Vec3 normal, Box3 box) : p_(point), n_(normalized(normal)), box_(box) {}
    Box3 bounds_mm() const override { return box_; }
    double distance_mm(Vec3 p) const override { return -dot(p - p_, n_); }
    Vec3 gradient(Vec3) const override { return -n_; }

  private:
    Vec3 p_, n_;
    Box3 box_;
};

}  // namespace tribo::field::test
