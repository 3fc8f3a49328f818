// SPDX-License-Identifier: MIT
#include "haptics/contact/force_field.hpp"

#include <algorithm>
#include <cmath>

#include "haptics/texture/haptic_texture.hpp"

namespace tribo::haptics {
namespace {

// From 0 to 1 without a step in value or slope.
double smooth(double t) {
    const double s = std::clamp(t, 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

}  // namespace

double cylinder_distance_mm(const Cylinder& a, const Cylinder& b) {
    const Vec3 u = a.length_mm * a.axis, v = b.length_mm * b.axis, r = a.end_mm - b.end_mm;
    const double uu = squared_length(u), vv = squared_length(v), uv = dot(u, v);
    const double ur = dot(u, r), vr = dot(v, r);
    const double determinant = uu * vv - uv * uv;
    // Parallel or without length: any point of the first will do to begin with.
    double s = determinant > 1e-12 * uu * vv ? std::clamp((uv * vr - ur * vv) / determinant, 0.0, 1.0) : 0;
    double t = vv > 0 ? (uv * s + vr) / vv : 0;
    if (t < 0 || t > 1 || vv <= 0) {
        t = std::clamp(t, 0.0, 1.0);
        s = uu > 0 ? std::clamp((uv * t - ur) / uu, 0.0, 1.0) : 0;
    }
    return length(r + s * u - t * v) - a.radius_mm - b.radius_mm;
}

FieldForce ForceField::render(const ForceFieldInput& m) noexcept {
    FieldForce out;
    const double share = options_.tick_s / options_.switch_s;
    way_ = std::clamp(way_ + (cutting_on_ ? share : -share), 0.0, 1.0);
    const double cut = smooth(way_);
    if (!is_finite(m.finger.end_mm)) {
        begun_ = false;
        return out;
    }
    const Vec3 feed = begun_ ? (m.cutter.end_mm - last_cutter_) / options_.tick_s : Vec3{};
    last_cutter_ = m.cutter.end_mm;
    begun_ = true;
    if (cut <= 0) return out;
    const double gap = cylinder_distance_mm(m.cutter, m.finger);
    out.nearness = smooth((options_.far_mm - gap) / (options_.far_mm - options_.near_mm));
    if (out.nearness <= 0) return out;
    const double felt = cut * out.nearness;
    out.cutting_n = felt * cutting_.force_n(m.at_s);
    if (m.texture != nullptr) {
        const TextureTouch touch{m.cutter.end_mm, feed, options_.texture_press_mm};
        out.texture_n =
            felt * texture_force(*m.texture, touch, options_.texture_stiffness_n_per_mm, 1 / options_.tick_s);
    }
    return out;
}

}  // namespace tribo::haptics
