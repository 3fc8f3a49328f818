// SPDX-License-Identifier: MIT
#include "haptics/field_contact.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tribo::haptics {
namespace {

// A proxy within this of the surface is on it, mm.
constexpr double kSkin = 1e-6;
// The proxy has settled when its way along the surface is below this share of the penetration: the share of
// the force's direction that is still wrong.
constexpr double kSettled = 2e-3;
// At an edge a face goes on if it is still there so far beyond it, mm, and so square to the way.
constexpr double kPeek = 1e-5, kGrazing = 0.1;
// Normals within about 18 degrees are one side that bends; beyond, two sides that meet.
constexpr double kOneSide = 0.95;
// A surface that faces away like this is the other side of a wall, or of a slot.
constexpr double kOtherSide = -0.5;
// A step that ends this share of its length above the surface has gone over an edge.
constexpr double kOverEdge = 0.5;
// Longer than this share of what is left, a step is a leap.
constexpr double kFarther = 1.25;
// ... which must gain this share of the rest, squared.
constexpr double kGain = 0.5;
constexpr double kShorter = 0.25, kShortest = 0.1;
// In flight, contact is made where the free ball is smaller than this share of the way to go.
constexpr double kNear = 0.02;
// ... and smaller than this share of a ball's radius.
constexpr double kNearBall = 0.1;
// The anchor's ball may miss the proxy by this share of its height, as rounding of curved sweeps does.
constexpr double kTouches = 0.01;
constexpr double kLowest = 1e-4, kHighest = 0.5;  // height of the anchor, mm
constexpr int kMostSlides = 8;
// A landing this much (of the step's length) above or below the trial is looked at again.
constexpr double kLeap = 0.02;
constexpr int kMostLandings = 3;
constexpr int kMostTries = 8;
constexpr int kMostLinks = 24;  // of a chain of balls, at once
constexpr int kMostClimbs = 24;

contact::HalfSpace side_of(Vec3 normal) {
    return {-normal, 0, 0};
}

Vec3 limited(Vec3 v, double most) {
    const double l = length(v);
    return l > most ? (most / l) * v : v;
}

}  // namespace

FieldContact::FieldContact(const contact::DistanceField& field, const ContactOptions& options)
    : field_(&field) {
    set_options(options);
    (void)gap_.set_balls(std::array{Vec3{}});
}

void FieldContact::set_options(const ContactOptions& o) {
    assert(o.stiffness_n_per_mm > 0 && o.probe_radius_mm >= 0 && o.tick_s > 0);
    assert(o.friction_kinetic >= 0 && o.friction_static >= o.friction_kinetic);
    options_ = o;
    if (o.probe_radius_mm != gap_.radius_mm()) reset();
    gap_.set_radius(o.probe_radius_mm);
}

void FieldContact::reset() {
    phase_ = Phase::begin;
    gap_.forget();
}

Contact FieldContact::update(Vec3 probe, std::span<const Vec3> balls_mm) noexcept {
    // What was free for the probe as it was turned is so for the turned one less what that moved.
    const double turned_mm = gap_.set_balls(balls_mm);
    anchor_.radius -= turned_mm;
    return tick(probe, turned_mm > 0);
}

Contact FieldContact::update(Vec3 probe) noexcept {
    return tick(probe, false);
}

Contact FieldContact::tick(Vec3 probe, bool turned) noexcept {
    first_query_ = gap_.queries();
    if (!is_finite(probe)) return {};
    last_proxy_ = at_.proxy;
    if (phase_ == Phase::begin) {
        last_proxy_ = at_.proxy = probe;
        sticking_ = true;
        phase_ = Phase::climb;
    }
    switch (phase_) {
        case Phase::begin:
        case Phase::climb:
            climb(probe);
            break;
        case Phase::free:
            fly(probe);
            break;
        case Phase::touching:
            if (turned) (void)land(at_);
            if (!stuck_ || !freed(probe)) slide(probe);
            break;
    }
    return answer(probe);
}

// Out of the material along its normals, until there is air.
void FieldContact::climb(Vec3 probe) {
    for (int n = 0; n < kMostClimbs && budget(4); ++n) {
        const ProbeGap::Gap g = gap_.measure(*field_, at_.proxy);
        if (g.gap_mm > kSkin) {
            last_proxy_ = at_.proxy;
            anchor_ = {at_.proxy, g.gap_mm};
            fly(probe);
            return;
        }
        // A little more than the distance, so that the proxy comes to stand in air.
        at_.proxy += (2 * kSkin - g.gap_mm) * g.normal;
    }
    at_.settled = false;
}

// From the anchor straight to the probe, through balls that hold no material.
void FieldContact::fly(Vec3 probe) {
    phase_ = Phase::free;
    // Further away a ball's nearest place is not measured.
    const double near = gap_.radius_mm() > 0 ? kNearBall * gap_.radius_mm() : 1e30;
    Anchor a = anchor_;
    for (;;) {
        const double way = distance(probe, a.at);
        if (way <= a.radius) {
            anchor_ = {probe, a.radius - way};
            at_.proxy = probe;
            at_.settled = true;
            return;
        }
        if (a.radius < std::max(kSkin, std::min(kNear * way, near))) break;
        anchor_ = a;
        if (!budget(1)) {
            at_.proxy = a.at;
            at_.settled = false;
            return;
        }
        a.at += (a.radius / way) * (probe - a.at);
        a.radius = gap_.clearance_mm(*field_, a.at, distance(probe, a.at));
    }
    // At the surface; the last ball, or what is left of it, reaches there.
    ProbeGap::Gap g = gap_.measure(*field_, a.at);
    Vec3 seen_at = a.at;
    // At a convex edge it is the face that the probe goes along, not the one that ends there.
    const Vec3 ahead = normalized(probe - last_proxy_, -g.normal),
               next_to = a.at + (g.gap_mm + kPeek) * ahead;
    const ProbeGap::Gap beyond = gap_.measure(*field_, next_to);
    if (beyond.gap_mm >= -2 * kSkin && std::abs(dot(beyond.normal, ahead)) < kGrazing) {
        g = beyond;
        seen_at = next_to;
    }
    at_ = {};
    at_.proxy = seen_at - g.gap_mm * g.normal;
    at_.normal = g.normal;
    at_.ball = g.ball;
    at_.sides.put(side_of(g.normal), kOneSide);
    anchor_ = {a.at, std::max(a.radius, 0.0)};
    phase_ = Phase::touching;
    stuck_ = false;
    sticking_ = true;
    ease_ = 1;
    height_ = std::clamp(distance(probe, at_.proxy), kLowest, kHighest);
    anchor_here();
    if (budget(kMostSlides)) slide(probe);
}

// The part of a way that the surface at the proxy allows.
Vec3 FieldContact::along(const Slide& s, Vec3 way) const {
    return s.sides.nearest(way);
}

// The sides at the proxy, and one more through `point`, where they stand.
contact::HalfSpaces FieldContact::corner_of(const Slide& s, Vec3 point, Vec3 normal) {
    contact::HalfSpaces corner = s.sides;
    for (int i = 0; i < corner.count; ++i) {
        contact::HalfSpace& h = corner.side[static_cast<std::size_t>(i)];
        h.offset = dot(h.normal, s.proxy);
    }
    corner.put({-normal, -dot(normal, point), 0}, kOneSide);
    return corner;
}

FieldContact::Slide FieldContact::slide_from_proxy(Vec3 probe, double longest_step) {
    Slide s = at_;
    s.settled = s.lost = false;
    const Vec3 from = s.proxy;
    Vec3 last_rest, last_step;
    double last_length = 0, leap = 0;
    // Of the step that should settle it: less after one that came no nearer to the probe. Cusps and bumps
    // that are small to the probe's depth turn the way back at each.
    double share = 1;
    bool moved = false;
    for (int n = 0; n < kMostSlides && budget(6); ++n) {
        const Vec3 way = probe - s.proxy;
        s.rest = along(s, way);
        s.press_mm = distance(way, s.rest);
        const double rest = length(s.rest);
        const double hold = (moved ? options_.friction_kinetic : this->hold()) * s.press_mm;
        if (rest <= hold + kSettled * s.press_mm + kSkin) {
            s.settled = true;
            if (moved && s.sides.count == 1 && leap <= kLeap * s.press_mm + kSkin) return s;
            // Held: is there still a surface? In a corner: do all its sides hold?
            const ProbeGap::Gap g = gap_.measure(*field_, s.proxy);
            s.ball = g.ball;
            if (g.gap_mm > 2 * kSkin) s.lost = !moved;
            if (g.gap_mm >= -2 * kSkin && !(moved && g.gap_mm > 2 * kSkin)) return s;
            s.settled = false;
            moved = true;
            leap = std::abs(g.gap_mm);
            const Vec3 landed = s.proxy - g.gap_mm * g.normal;
            if (s.sides.count == 1 && dot(g.normal, s.normal) > kOneSide) {
                s.proxy = landed;
                s.sides = {};
            } else {
                s.proxy = corner_of(s, landed, g.normal).nearest(s.proxy);
            }
            s.sides.put(side_of(g.normal), kOneSide);
            s.normal = g.normal;
            continue;
        }
        if (s.press_mm <= 0) return s;  // the surface does not hold the probe
        // The step that would settle it, were the surface to bend on as it did over the last step.
        if (last_length > 0) {
            const Vec3 change = s.rest - last_rest;
            const double up = -dot(last_step, change), down = squared_length(change);
            // On a bump that the probe is deeper under than its centre, there is nothing to settle at: away.
            ease_ = up > 0 && down > 0 ? std::clamp(up / down, 0.01, 1.2) : std::min(2 * ease_, 8.0);
        }
        const double goal = std::max(0.0, 1 - options_.friction_kinetic * s.press_mm / rest);
        const Vec3 step =
            limited((s.sides.count == 1 ? share * ease_ * goal : share * goal) * s.rest, longest_step);
        if (moved && distance(s.proxy + step, from) > longest_step) return s;
        const Vec3 trial = s.proxy + step;
        const ProbeGap::Gap g = gap_.measure(*field_, trial);
        const double size = length(step);
        if (s.sides.count == 1 && share > kShortest &&
            (g.gap_mm < -kOverEdge * size || dot(g.normal, s.normal) < kOtherSide)) {
            // Deep in material or through it, where nothing tells of the surface in between.
            share *= kShorter;
            last_length = 0;
            continue;
        }
        if (g.gap_mm > kOverEdge * size + kSkin) {
            if (size > kFarther * rest) {
                // Not an edge under the probe, but one far beyond it.
                share *= kShorter;
                last_length = 0;
                continue;
            }
            s.proxy = trial;
            s.lost = true;
            return s;
        }
        const Vec3 landed = trial - g.gap_mm * g.normal;
        const bool bends = dot(g.normal, s.normal) > kOneSide;
        ProbeGap::Gap last = g;
        Vec3 next = landed;
        contact::HalfSpaces sides;
        if (s.sides.count == 1 && (bends || g.gap_mm >= -kSkin)) {
            // After a leap in height what was nearest from the trial may not be so where it lands.
            for (int k = 0; k < kMostLandings && std::abs(last.gap_mm) > kLeap * size + kSkin && budget(6);
                 ++k) {
                last = gap_.measure(*field_, next);
                next -= last.gap_mm * last.normal;
            }
            sides.put(side_of(last.normal), kOneSide);
        } else if (g.gap_mm < -kSkin) {
            // Another side is in the way: the proxy stands where all of them meet.
            next = corner_of(s, landed, g.normal).nearest(trial);
            if (distance(next, trial) > size + kSkin) {
                // Not between here and the trial: the far side of a wall.
                share *= kShorter;
                last_length = 0;
                continue;
            }
            sides = s.sides;
            sides.put(side_of(g.normal), kOneSide);
        } else {
            // Along a corner: the sides that the step has not left are still there.
            for (int i = 0; i < s.sides.count; ++i) {
                const contact::HalfSpace& h = s.sides.side[static_cast<std::size_t>(i)];
                if (dot(h.normal, step) > -1e-3 * size) sides.put(h, kOneSide);
            }
            sides.put(side_of(g.normal), kOneSide);
        }
        // A step that goes beyond the probe may come down far on its other side.
        const double most = size > kFarther * rest ? std::sqrt(squared_length(way) - kGain * rest * rest)
                                                   : length(way) + kLeap * size;
        if (size > kSkin && distance(probe, next) > most) {
            share *= kShorter;
            last_length = 0;
            continue;
        }
        moved = true;
        leap = std::abs(last.gap_mm);
        s.sides = sides;
        s.normal = last.normal;
        s.ball = last.ball;
        last_rest = s.rest;
        last_step = next - s.proxy;
        last_length = bends && s.sides.count == 1 ? length(last_step) : 0;
        if (last_length == 0) ease_ = std::min(ease_, 1.0);
        share = 1;
        s.proxy = next;
    }
    // Cut short: on with the next tick, from a place that is in air.
    if (land(s)) return s;
    s = at_;
    s.settled = s.lost = false;
    return s;
}

// Out to the surface from a place a little way in the material. Whether it got there.
bool FieldContact::land(Slide& s) {
    for (int n = 0; n < kMostLandings; ++n) {
        const ProbeGap::Gap g = gap_.measure(*field_, s.proxy);
        if (g.gap_mm >= -2 * kSkin) return true;
        s.proxy -= g.gap_mm * g.normal;
        s.normal = g.normal;
        s.ball = g.ball;
        s.sides = {};
        s.sides.put(side_of(g.normal), kOneSide);
    }
    return false;
}

// Whether a chain of free balls leads from the anchor to `to`, which then is the anchor.
bool FieldContact::chain(const Anchor& to) {
    // What it takes is not left for a shorter way.
    const long last = gap_.queries() + kMostLinks;
    Anchor a = anchor_;
    for (;;) {
        const double way = distance(to.at, a.at);
        if (way <= a.radius + to.radius) {
            anchor_ = to;
            return true;
        }
        if (a.radius < kSkin || !budget(1) || gap_.queries() >= last) return false;
        a.at += (a.radius / way) * (to.at - a.at);
        a.radius = gap_.clearance_mm(*field_, a.at, distance(to.at, a.at));
    }
}

// Finds an anchor over the slide's end that the present anchor leads to.
bool FieldContact::tie(const Slide& s) {
    Vec3 up;
    for (int n = 0; n < s.sides.count; ++n) up -= s.sides.side[static_cast<std::size_t>(n)].normal;
    up = normalized(up, s.normal);
    double height =
        std::clamp(std::max(1.5 * distance(s.proxy, at_.proxy), 0.5 * height_), kLowest, kHighest);
    for (int tries = 0; tries < 3 && budget(1); ++tries) {
        const Vec3 at = s.proxy + height * up;
        const Anchor a{at, gap_.clearance_mm(*field_, at, height)};
        bool down = a.radius >= (1 - kTouches) * height;
        // Between walls the ball does not reach down to the proxy, but a row of smaller ones does.
        Anchor low = a;
        while (!down && low.radius > 0.1 * distance(low.at, s.proxy) && budget(2)) {
            const double left = distance(low.at, s.proxy);
            low.at += (low.radius / left) * (s.proxy - low.at);
            low.radius = gap_.clearance_mm(*field_, low.at, left);
            down = distance(low.at, s.proxy) <= low.radius + kTouches * height;
        }
        if (down && chain(a)) {
            height_ = height;
            return true;
        }
        // A long way is left to shorter steps.
        if (!budget(kMostQueries / 2)) return false;
        height = std::max(kLowest, 0.25 * height);
    }
    return false;
}

// An anchor whose ball touches the proxy: free, and where the proxy is.
void FieldContact::anchor_here() {
    Vec3 up;
    for (int n = 0; n < at_.sides.count; ++n) up -= at_.sides.side[static_cast<std::size_t>(n)].normal;
    up = normalized(up, at_.normal);
    for (double height = height_; height > 0.1 * kLowest && budget(1); height *= 0.25) {
        const Vec3 at = at_.proxy + height * up;
        const Anchor a{at, gap_.clearance_mm(*field_, at, height)};
        if (a.radius < (1 - kTouches) * height) continue;
        anchor_ = a;
        height_ = height;
        return;
    }
}

// Of a proxy for which the last tick found no way: if it has come to stand in material (a nearest place was
// missed before), out again to the air that it is tied to.
bool FieldContact::freed(Vec3 probe) {
    if (gap_.measure(*field_, at_.proxy).gap_mm >= -2 * kSkin) return false;
    const double room = gap_.measure(*field_, anchor_.at).gap_mm;
    if (room > kSkin) {
        anchor_.radius = room;
        fly(probe);
    } else {
        phase_ = Phase::climb;
        climb(probe);
    }
    return true;
}

void FieldContact::slide(Vec3 probe) {
    double longest = 1e30;
    bool settled = false;
    for (int tries = 0; !settled && tries < kMostTries && budget(8); ++tries) {
        const Slide s = slide_from_proxy(probe, longest);
        if (s.lost) {
            // Over an edge, or the material is gone: through the air from here.
            const double room = gap_.clearance_mm(*field_, s.proxy, distance(probe, s.proxy));
            if (chain({s.proxy, room})) {
                at_.proxy = s.proxy;
                fly(probe);
                return;
            }
        } else if (s.press_mm <= 0 || (s.settled && s.press_mm <= kSkin)) {
            fly(probe);
            return;
        } else if (s.proxy == at_.proxy || tie(s)) {
            at_ = s;
            settled = s.settled;
            if (longest > 1e29) break;
            longest *= 2;
            continue;
        }
        // No way there was proved: in smaller steps, from where the proxy is.
        if (longest > 1e29) anchor_here();
        longest = longest > 1e29 ? std::max(anchor_.radius, kLowest) : 0.25 * longest;
        if (longest < 0.01 * kLowest) break;
    }
    at_.settled = settled;
    stuck_ = !settled && at_.proxy == last_proxy_;
    if (at_.proxy == last_proxy_) {
        sticking_ = true;
    } else {
        sticking_ = distance(at_.proxy, last_proxy_) < options_.stick_mm_per_s * options_.tick_s;
    }
}

Contact FieldContact::answer(Vec3 probe) const {
    Contact c;
    c.proxy_mm = at_.proxy;
    c.settled = at_.settled;
    c.normal = at_.normal;
    c.slip_mm_per_s = (at_.proxy - last_proxy_) / options_.tick_s;
    if (phase_ != Phase::touching) return c;
    const Vec3 way = probe - at_.proxy, rest = along(at_, way), press = way - rest;
    c.penetration_mm = length(press);
    if (!(c.penetration_mm > 0)) return c;
    c.in_contact = true;
    c.sliding = !sticking_;
    if (at_.sides.count > 1) c.normal = -1 / c.penetration_mm * press;
    // What friction does not hold is the way that the proxy has still to go.
    const double drag = options_.friction_static * c.penetration_mm, left = length(rest);
    const Vec3 held = left > drag ? (drag / left) * rest : rest;
    c.force_n = -options_.stiffness_n_per_mm * (press + held);
    c.lever_mm = gap_.offset_mm(at_.ball) - gap_.radius_mm() * at_.normal;
    return c;
}

}  // namespace tribo::haptics
