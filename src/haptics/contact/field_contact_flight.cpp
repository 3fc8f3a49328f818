// SPDX-License-Identifier: MIT
// The proxy on its way through the air, and where it comes down.
#include <algorithm>

#include "haptics/contact/field_contact.hpp"

namespace tribo::haptics {
namespace {

// Contact is made where the free ball is smaller than this share of the way to go, and of a ball's radius.
constexpr double kNear = 0.02, kNearBall = 0.1;
// A flight so near to a surface, of a ball's radius, that the probe is not behind rises by this share of the
// way to go.
constexpr double kLow = 0.9, kLift = 0.1;
// At an edge a face goes on if it is still there so far beyond it, mm, and so square to the way.
constexpr double kPeek = 1e-5, kGrazing = 0.1;
// A way of a stuck ball that comes so near to a wall, of its radius, is none.
constexpr double kNarrow = 0.02;

}  // namespace

// Whether no wall is between two places of the centres of the probe's balls, nor a gap that is much narrower
// than they are.
bool FieldContact::is_open(Vec3 from, Vec3 to) {
    const double least = std::max(kSkin, kNarrow * gap_.radius_mm());
    for (;;) {
        ++queries_;
        const double way = distance(to, from), free = gap_.room_of_centres_mm(*field_, from, way);
        if (way <= free) return true;
        if (free < least || !budget(1)) return false;
        from += (free / way) * (to - from);
    }
}

// A ball as wide as a slot may be wedged at its mouth, or creep along its walls, where no free ball has room
// to lead it on. Where the probe has long been in air, and no wall is between its centre and the proxy's,
// straight or along the sides that hold the proxy, it begins anew from there; so does a probe that has turned
// where there was no room for it.
void FieldContact::release_stuck_proxy(Vec3 probe) {
    stuck_s_ = 0;
    const double room = measure(probe).gap_mm;
    if (room <= kSkin) return;
    const Vec3 aside = at_.proxy + split(at_, probe).rest;
    const bool was_cut_off = anchor_.radius < -skin();
    if (!was_cut_off && !is_open(at_.proxy, probe) && !(is_open(at_.proxy, aside) && is_open(aside, probe))) {
        // A turn may have taken the way from its anchor to it: back to that.
        if (gap_.balls() == 1 || anchor_.radius <= kSkin) return;
        at_.proxy = last_proxy_ = anchor_.at;
        phase_ = Phase::free;
        return;
    }
    anchor_ = {probe, room};
    at_.proxy = last_proxy_ = probe;
    phase_ = Phase::free;
}

// Out of the material along its normals, until there is air.
FieldContact::Next FieldContact::climb() {
    const ProbeGap::Gap g = measure(at_.proxy);
    if (g.gap_mm > kSkin) {
        last_proxy_ = at_.proxy;
        anchor_ = {at_.proxy, g.gap_mm};
        phase_ = Phase::free;
        return Next::more;
    }
    // A little more than the distance, so that the proxy comes to stand in air.
    at_.proxy += (2 * kSkin - g.gap_mm) * g.normal;
    return Next::more;
}

// From the anchor straight to the probe, through balls that hold no material.
FieldContact::Next FieldContact::fly(Vec3 probe) {
    // Further away than its radius a ball's nearest place is not measured.
    const double unit = gap_.radius_mm() > 0 ? gap_.radius_mm() : 1e30;
    Anchor a = anchor_;
    for (;;) {
        const double way = distance(probe, a.at);
        if (way <= a.radius + kSkin) {
            anchor_ = a;
            at_.proxy = probe;
            settled_ = true;
            return Next::nothing;
        }
        if (a.radius < std::max(kSkin, std::min(kNear * way, kLow * unit))) {
            // A surface that the probe is not behind does not hold it.
            const ProbeGap::Gap g = measure(a.at);
            const bool holds = dot(probe - a.at, g.normal) < -g.gap_mm;
            if (!holds && (a.radius >= kSkin || gap_.radius_mm() > 0)) lift(a, g.normal, kLift * way);
            if (a.radius < kSkin || (holds && a.radius < kNearBall * unit)) {
                touch_down(probe, a, g);
                return Next::more;
            }
        }
        anchor_ = a;
        at_.proxy = a.at;
        if (!budget(kStepQueries)) return Next::nothing;
        a.at += (a.radius / way) * (probe - a.at);
        a.radius = clearance_mm(a.at, distance(probe, a.at));
    }
}

// Along a surface there is only room for small balls; a little above it the next ones are larger. Near a wall
// there is less room so high, and more a little lower. In a corner there is room only away from both sides.
void FieldContact::lift(Anchor& a, Vec3 up, double height) {
    for (int sides = 1; sides <= 2; ++sides) {
        for (double h = height; h > std::max(2 * a.radius, kLowest) && budget(kStepQueries); h *= kShorter) {
            const Vec3 at = a.at + h * up;
            const Anchor above{at, clearance_mm(at, h)};
            if (above.radius > std::max(a.radius, kSkin) && h <= a.radius + above.radius + bridge_mm()) {
                a = above;
                return;
            }
        }
        if (a.radius >= kSkin || !budget(kStepQueries)) return;
        const Vec3 both = normalized(up + measure(a.at + kLowest * up).normal, up);
        if (dot(both, up) > kOneSide) return;
        up = both;
    }
}

// At the surface that was seen next to a ball, or what is left of one, that reaches there.
void FieldContact::touch_down(Vec3 probe, Anchor from, ProbeGap::Gap g) {
    Vec3 seen_at = from.at;
    const Vec3 ahead = normalized(probe - last_proxy_, -g.normal),
               next_to = from.at + (g.gap_mm + kPeek) * ahead;
    const ProbeGap::Gap beyond = measure(next_to);
    // At a convex edge it is the face that the probe goes along, not the one that ends there.
    if (beyond.gap_mm >= -2 * kSkin && std::abs(dot(beyond.normal, ahead)) < kGrazing) {
        g = beyond;
        seen_at = next_to;
    }
    at_ = {};
    at_.proxy = seen_at - g.gap_mm * g.normal;
    at_.touch(g);
    at_.sides.put({-g.normal, 0, 0}, kOneSide);
    // In a corner the side that was nearest may not be the one that holds.
    if (dot(probe - at_.proxy, g.normal) >= 0 && beyond.gap_mm < 0 &&
        dot(probe - next_to, beyond.normal) < 0) {
        at_.proxy = next_to;
        (void)correct(at_, beyond);
    }
    if (from.radius > anchor_.radius) anchor_ = from;
    phase_ = Phase::touching;
    sticking_ = true;
    side_step_.reset();
    height_ = std::clamp(distance(probe, at_.proxy), kLowest, kHighest);
    stride_mm_ = 1e30;
    moved_ = false;
    looks_ = next_look_ = 0;
    (void)tie(at_);
}

FieldContact::Next FieldContact::take_off() {
    phase_ = Phase::free;
    return Next::more;
}

}  // namespace tribo::haptics
