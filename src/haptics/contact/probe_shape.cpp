// SPDX-License-Identifier: MIT
#include "haptics/contact/probe_shape.hpp"

#include "base/math.hpp"

namespace tribo::haptics {

ProbeShape ProbeShape::ray(double length_mm) {
    constexpr int kBalls = 21;
    ProbeShape shape;
    shape.balls_.clear();
    for (int n = 0; n < kBalls; ++n) shape.balls_.push_back({0, 0, length_mm * n / (kBalls - 1)});
    return shape;
}

ProbeShape ProbeShape::cylinder(double radius_mm, double length_mm) {
    constexpr int kRound = 12, kRings = 4;
    ProbeShape shape;  // the middle of its lower end
    for (int ring = 0; ring < kRings; ++ring) {
        for (int n = 0; n < kRound; ++n) {
            double sine, cosine;
            math::sincos(math::kTwoPi * n / kRound, sine, cosine);
            shape.balls_.push_back({radius_mm * cosine, radius_mm * sine, length_mm * ring / (kRings - 1)});
        }
    }
    return shape;
}

void ProbeShape::turned(Vec3 stylus, std::span<Vec3> out) const noexcept {
    const Vec3 x = any_perpendicular(stylus), y = cross(stylus, x);
    for (std::size_t n = 0; n < balls_.size(); ++n)
        out[n] = balls_[n].x * x + balls_[n].y * y + balls_[n].z * stylus;
}

}  // namespace tribo::haptics
