// SPDX-License-Identifier: MIT
#include "haptics/contact/force_field.hpp"

#include <algorithm>
#include <cmath>

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

double ForceField::Fader::step(bool on, double share) {
    way = std::clamp(way + (on ? share : -share), 0.0, 1.0);
    return smooth(way);
}

FieldForce ForceField::render(const FieldMoment& m) noexcept {
    FieldForce out;
    const double share = options_.tick_s / options_.switch_s;
    const double cut = cut_.step(mode_ == FeelMode::cut && cutting_on_, share);
    const double inspected = smooth(inspect_.way);
    const double inspect = inspect_.step(mode_ == FeelMode::inspect, share);
    if (!is_finite(m.finger.end_mm)) {
        begun_ = false;
        return out;
    }
    const Vec3 feed = begun_ ? (m.cutter.end_mm - last_cutter_) / options_.tick_s : Vec3{};
    last_cutter_ = m.cutter.end_mm;
    begun_ = true;

    // The contact follows the hand even where it is not felt, so that it is there when it is.
    touch_ = contact_ != nullptr ? contact_->update(m.finger.end_mm) : Contact{};
    out.in_contact = touch_.in_contact && inspect > 0;
    out.surface_n = inspect * touch_.force_n;
    if (contact_ != nullptr) {
        out.lent_nmm = (inspect - inspected) * 0.5 * squared_length(touch_.force_n) /
                       contact_->options().stiffness_n_per_mm;
    }
    const double press_n = dot(touch_.force_n, touch_.normal);

    if (cut > 0) {
        const double gap = cylinder_distance_mm(m.cutter, m.finger);
        out.nearness = smooth((options_.far_mm - gap) / (options_.far_mm - options_.near_mm));
        if (out.nearness > 0) {
            const double felt = cut * out.nearness;
            if (cutting_ != nullptr) out.cutting_n = felt * cutting_->force_n(m.at_s);
            if (m.texture != nullptr) {
                const TextureTouch touch{m.cutter.end_mm, feed, options_.texture_press_mm};
                out.texture_n += felt * texture_force(*m.texture, touch, options_.texture_stiffness_n_per_mm,
                                                      1 / options_.tick_s, options_.texture_gain_cut);
            }
        }
    }
    if (inspect > 0 && touch_.in_contact) {
        const contact::TextureRecord* record = textures_ != nullptr && options_.texture_gain_inspect > 0
                                                   ? textures_->nearest(touch_.proxy_mm)
                                                   : nullptr;
        if (record != nullptr) {
            const TextureTouch touch{touch_.proxy_mm, touch_.slip_mm_per_s, touch_.penetration_mm};
            // Comes in over the first tenth of a millimetre: a record may stand higher than the hand presses.
            const double onset = smooth(touch_.penetration_mm / 0.1);
            out.texture_n += inspect * onset *
                             texture_force(*record, touch, options_.texture_stiffness_n_per_mm,
                                           1 / options_.tick_s, options_.texture_gain_inspect);
        }
    }
    if (vibration_ != nullptr) {
        const double v = vibration_->next(length(touch_.slip_mm_per_s), touch_.in_contact ? press_n : 0);
        out.texture_n += inspect * v * touch_.normal;
    }
    return out;
}

}  // namespace tribo::haptics
