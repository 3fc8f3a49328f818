// SPDX-License-Identifier: MIT
// The soft shadow of the sun on a part and on the ground below it.
#pragma once

#include <array>

#include "base/mesh.hpp"
#include "base/vec3.hpp"
#include "report/picture/raster.hpp"

namespace tribo::report {

// Directions to the sun are Studio::to_sun(). Needs 8 bytes of some two million texels during its life.
class SunShadow {
  public:
    explicit SunShadow(const TriangleMesh& mesh);

    // Share of the sun that reaches a point of a surface (0..1), `normal` (unit) towards the light or away.
    float light(Vec3 point_mm, Vec3 normal) const;
    // Where the shadow of a point falls on the ground.
    Vec3 on_ground(Vec3 point_mm) const;
    double ground_mm() const { return ground_mm_; }  // a little below the part

  private:
    static constexpr std::size_t kTaps = 12;
    Seen see(Vec3 point_mm) const;
    Buffer map_;
    std::array<Vec3, kTaps> taps_;
    Vec3 sun_, right_, up_;
    double left_ = 0, top_ = 0, low_ = 0, per_mm_ = 1, per_height_ = 1;
    double ground_mm_ = 0;
};

}  // namespace tribo::report
