// SPDX-License-Identifier: MIT
// A plane cut by passes of a ball, as a distance field in closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/mesh.hpp"
#include "contact/distance_field.hpp"

namespace tribo::surface::test {

// Material below z = top. Pass i is a round groove along x whose bottom line is (y_i, z_i).
class Grooves : public contact::DistanceField {
  public:
    struct Pass {
        double y, bottom;
    };
    Grooves(double top, double radius, std::vector<Pass> passes)
        : top_(top), radius_(radius), passes_(std::move(passes)) {}

    double distance_mm(Vec3 p) const override {
        double d = p.z - top_;
        for (const Pass& pass : passes_) {
            d = std::max(d, radius_ - std::hypot(p.y - pass.y, std::min(0.0, p.z - pass.bottom - radius_)));
        }
        return d;
    }
    Vec3 normal(Vec3) const override { return {0, 0, 1}; }

  private:
    double top_, radius_;
    std::vector<Pass> passes_;
};

// Passes that touch z = 0 from y = first on, `count` of them.
inline std::vector<Grooves::Pass> row(double first, double sidestep, int count) {
    std::vector<Grooves::Pass> passes(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) passes[static_cast<std::size_t>(i)] = {first + i * sidestep, 0};
    return passes;
}

// The rectangle x0..x1, y0..y1 at z = 0, facing up, in squares of about 5 mm.
inline TriangleMesh rectangle(double x0, double x1, double y0, double y1) {
    TriangleMesh mesh;
    const auto nx = static_cast<std::uint32_t>(std::ceil((x1 - x0) / 5));
    const auto ny = static_cast<std::uint32_t>(std::ceil((y1 - y0) / 5));
    for (std::uint32_t j = 0; j <= ny; ++j) {
        for (std::uint32_t i = 0; i <= nx; ++i) {
            mesh.positions.push_back({static_cast<float>(x0 + (x1 - x0) * i / nx),
                                      static_cast<float>(y0 + (y1 - y0) * j / ny), 0});
        }
    }
    for (std::uint32_t j = 0; j < ny; ++j) {
        for (std::uint32_t i = 0; i < nx; ++i) {
            const std::uint32_t a = j * (nx + 1) + i, b = a + 1, c = a + nx + 1, d = c + 1;
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({a, d, c});
        }
    }
    return mesh;
}

}  // namespace tribo::surface::test
