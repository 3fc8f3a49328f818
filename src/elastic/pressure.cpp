// SPDX-License-Identifier: MIT
#include "elastic/pressure.hpp"

#include "base/math.hpp"

namespace tribo::elastic {
namespace {

// e^-5: the remainder of eq. 1 at the centre of the contact.
constexpr double kCentre = 0x1.b993fe00d5376p-8;

// Decay length around the contact, in half axes. With it the slope is continuous at the edge of the contact.
constexpr double kDecay = (1 - kEdgeDrop) * (1 - kCentre) / (5 * kEdgeDrop);

constexpr double kLog2E = 0x1.71547652b82fep+0;

}  // namespace

ShareLaw share_law(ContactShape shape) {
    ShareLaw law;
    law.inner_rate = law.outer_rate = static_cast<float>(-kLog2E / kDecay);
    law.outer = law.outer_from_centre = 1;
    law.edge = -1;  // a point has no inside
    if (shape == ContactShape::point) return law;
    law.edge = law.origin = 1;
    law.inner_base = static_cast<float>(1 + kEdgeDrop * kCentre / (1 - kCentre));
    law.inner = static_cast<float>(-kEdgeDrop / (1 - kCentre));
    law.inner_rate = static_cast<float>(5 * kLog2E);
    law.outer = static_cast<float>(1 - kEdgeDrop);
    law.outer_from_centre = static_cast<float>((1 - kEdgeDrop) * math::exp(1 / kDecay));
    return law;
}

double published_pressure(ContactShape shape, double distance_mm, double held_s, double radius_mm) {
    const double reach_mm = kPublishedReach * radius_mm;
    if (!(distance_mm <= reach_mm)) return 0;
    if (shape == ContactShape::point) {
        return held_s > 0 ? -math::exp(-5 * distance_mm / (reach_mm * held_s)) * held_s : 0;
    }
    if (distance_mm <= radius_mm) {
        return (math::exp(5 * (distance_mm - radius_mm) / radius_mm) - 1) / 10 - held_s;
    }
    if (!(held_s > 0)) return 0;
    return -math::exp(-5 * (distance_mm - radius_mm) / (reach_mm * held_s)) * (held_s - 1.0 / 50);
}

}  // namespace tribo::elastic
