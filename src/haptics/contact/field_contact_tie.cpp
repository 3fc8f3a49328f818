// SPDX-License-Identifier: MIT
// How the proxy is tied: balls of free space, from place to place.
#include <algorithm>

#include "haptics/contact/field_contact.hpp"

namespace tribo::haptics {
namespace {

// The anchor's ball may miss the proxy by this share of its height, as rounding of curved sweeps does.
constexpr double kTouches = 0.01;
// It is so many steps high at least: the next ones end at the same ball.
constexpr double kStepsHigh = 2;
// Where there is room for less than this share of its height another way leads up.
constexpr double kCramped = 0.25;
// In a groove so sharp (the sine of half its angle) no ball is looked for at its bottom; two balls there
// overlap by this share.
constexpr double kSharpest = 0.02, kOverlap = 0.99;
// An anchor at less than this share of the height that is asked for is low.
constexpr double kLowAnchor = 0.5;
// An anchor so many times its radius away from the proxy is of no use any more.
constexpr double kLeftBehind = 10;

}  // namespace

// Whether a chain of free balls leads from the anchor to `to`, which then is the anchor.
bool FieldContact::chain(const Anchor& to) {
    if (to.radius < kSkin) return false;
    Anchor a = anchor_;
    for (int links = 0;; ++links) {
        const double way = distance(to.at, a.at), reach = a.radius + bridge_mm();
        if (way <= reach + to.radius) {
            anchor_ = to;
            return true;
        }
        chained_mm_ = distance(a.at, anchor_.at);
        if (a.radius < -skin() || reach < kSkin) return false;
        if (links == kMostLinks || !budget(1)) {
            // From an anchor that was left far away it goes on from here next time.
            if (a.radius > kSkin && distance(a.at, at_.proxy) < distance(anchor_.at, at_.proxy)) anchor_ = a;
            return false;
        }
        a.at += (reach / way) * (to.at - a.at);
        a.radius = clearance_mm(a.at, distance(to.at, a.at));
    }
}

// An anchor that a turn of the probe has taken the room from is looked at again, and given up for the ball
// over the proxy where nothing is left of it: a probe that turns has no other way to it.
void FieldContact::renew_anchor() {
    if (anchor_.radius > kSkin) return;
    anchor_.radius = clearance_mm(anchor_.at, kHighest);
    const Vec3 up = up_from(at_);
    for (double height = height_; anchor_.radius <= kSkin && height > kSkin && budget(1); height *= 0.25) {
        const Vec3 at = at_.proxy + height * up;
        const Anchor a{at, clearance_mm(at, height, true)};
        if (a.radius > kSkin && reaches_down(a, at_.proxy, std::max(kTouches * height, skin()))) anchor_ = a;
    }
}

// An anchor that was left far behind in a dead end, from which no chain leads on, is replaced by one over the
// proxy: that was tied when it came here.
void FieldContact::fetch_anchor() {
    if (distance(anchor_.at, at_.proxy) <= kLeftBehind * anchor_.radius) return;
    const Anchor left = anchor_;
    anchor_ = {at_.proxy, 0};
    renew_anchor();
    if (anchor_.radius <= kSkin) anchor_ = left;
}

// An anchor near the bottom of a sharp groove has hardly room to lead on: the ball so high above the same
// place takes its turn.
void FieldContact::raise_anchor(double height_mm) {
    if (gap_.radius_mm() > 0 || distance(anchor_.at, at_.proxy) > kLowAnchor * height_mm || !budget(1))
        return;
    const Vec3 at = at_.proxy + height_mm * up_from(at_);
    const Anchor above{at, clearance_mm(at, height_mm, true)};
    if (above.radius > anchor_.radius &&
        reaches_down(above, at_.proxy, std::max(kTouches * height_mm, skin())))
        anchor_ = above;
}

// Away from all sides as fast as can be: the shortest way to 1 above each.
Vec3 FieldContact::up_from(const Place& place) {
    contact::HalfSpaces above = place.sides;
    for (int n = 0; n < above.count; ++n) above.side[static_cast<std::size_t>(n)].offset = -1;
    return normalized(above.nearest({}), place.normal);
}

// Whether a ball, and ever smaller ones towards the proxy, reach it: between walls the first does not.
// Between two that meet at the proxy they shrink with the way that is left: the next one is put where it just
// touches this one, and where there is less room than that, where this one ends.
bool FieldContact::reaches_down(Anchor ball, Vec3 proxy, double tolerance_mm) {
    for (;;) {
        const double left = distance(ball.at, proxy);
        if (left <= ball.radius + tolerance_mm) return true;
        if (ball.radius <= kSharpest * left || !budget(1)) return false;
        const Vec3 ahead = (proxy - ball.at) / left;
        const double step = kOverlap * 2 * ball.radius / (1 + ball.radius / left);
        Anchor next{ball.at + step * ahead};
        next.radius = clearance_mm(next.at, left - step);
        if (next.radius < step - ball.radius) {
            if (!budget(1)) return false;
            next.at = ball.at + ball.radius * ahead;
            next.radius = clearance_mm(next.at, left - ball.radius);
        }
        ball = next;
    }
}

// Finds an anchor that touches the proxy and that the present anchor leads to, where that does not still
// touch.
bool FieldContact::tie(const Place& to) {
    if (distance(to.proxy, anchor_.at) <= anchor_.radius + std::max(kTouches * anchor_.radius, skin()))
        return true;
    const double step = distance(to.proxy, at_.proxy);
    if (gap_.radius_mm() > 0 && step <= bridge_mm()) {
        // A short step of a ball needs no free ball above it.
        const double gap_mm = measure(to.proxy).gap_mm;
        if (gap_mm < -std::max(kTouches * step, kLens)) return false;
        anchor_ = {to.proxy, std::max(0.0, gap_mm)};
        return true;
    }
    Vec3 up = up_from(to);
    double height = std::clamp(std::max(kStepsHigh * step, height_), kLowest, kHighest);
    const Vec3 first = up;
    if (misled_) raise_anchor(height);
    for (int tries = 0; tries < 4 && budget(2); ++tries) {
        const Vec3 at = to.proxy + height * up;
        const Anchor a{at, clearance_mm(at, height, true)};
        if (reaches_down(a, to.proxy, std::max(kTouches * height, skin()))) {
            const bool leads = chain(a);
            misled_ = !leads;
            height_ = leads ? height : std::max(kLowest, 0.25 * height);
            return leads;
        }
        // Another side is near, one that the step has left or comes to: there is room only away from it too,
        // in a sharp groove between the two ways.
        Vec3 tilted = up;
        if (tries == 0) {
            const ProbeGap::Gap g = measure(at);
            tilted = normalized(up + g.normal, up);
            if (dot(g.normal, up) < kOneSide)
                cramping_ = {-g.normal, -dot(g.normal, at - g.gap_mm * g.normal), 0};
        }
        if (tries == 1 && a.radius < kCramped * height) tilted = normalized(first + up, up);
        if (dot(tilted, up) < kOneSide) {
            up = tilted;
        } else {
            height = std::max(kLowest, 0.25 * height);
        }
    }
    height_ = height;
    return false;
}

}  // namespace tribo::haptics
