// SPDX-License-Identifier: MIT
#include "haptics/contact/field_contact.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tribo::haptics {
namespace {

// The proxy has settled when its way along the surface is below this share of the penetration: the share of
// the force's direction that is still wrong.
constexpr double kSettled = 2e-3;
// A surface that faces away like this is the other side of a wall, or of a slot.
constexpr double kOtherSide = -0.5;
// A step that ends this share of its length above the surface has gone over an edge, that far below it into
// what tells nothing of the surface between.
constexpr double kOff = 0.5;
// A step gains at least this share of what it promises; one over an edge goes no farther than this beyond the
// probe.
constexpr double kGain = 0.1, kBeyond = 1.25;
// A refused step is followed by one of this share or of kShorter, a taken one allows one longer by the
// inverse of that.
constexpr double kLittleShorter = 0.75;
// Normals less apart than this are of the same place of a side (product).
constexpr double kSameSide = 0.9999;
// Normals at both ends of the shortest step that are less alike are of two sides.
constexpr double kCrease = 1 - 1e-7;
// So far a corner is looked into behind its sides, mm, where the way between the others goes behind it by at
// least this share.
constexpr double kLook = 1e-3, kLeastBehind = 0.01;
// Where another side is in the way, a step ends this share of its length above the plane that it comes from
// only in a hollow: 0.16 in one that bends by kOneSide.
constexpr double kHollow = 0.1;
// A step along a corner has left a side, or passed it, by this share of its length.
constexpr double kLeft = 1e-3;
// A landing this much (of the step's length) off the trial is looked at again, so often.
constexpr double kLeap = 0.02;
constexpr int kMostLandings = 3;
// So often a proxy in material is pushed out; in a corner of bent sides each push takes most of the depth.
// Farther away than so many times its depth, or kHighest, is not where it came from.
constexpr int kMostPushes = 8;
constexpr double kPushedFar = 4;
// A proxy that in a tick comes by less than this share of its way, and this for so long, s, is let go where
// the probe is in air.
constexpr double kCreeping = 0.1, kStuckS = 3e-3;

contact::HalfSpace side_of(Vec3 normal) {
    return {-normal, 0, 0};
}

// The sides of a place as planes through its proxy.
contact::HalfSpaces planes_of(contact::HalfSpaces sides, Vec3 proxy) {
    for (int n = 0; n < sides.count; ++n) {
        contact::HalfSpace& h = sides.side[static_cast<std::size_t>(n)];
        h.offset = dot(h.normal, proxy);
    }
    return sides;
}

// Which sides of a corner to look behind together, one bit each: each alone, and of three or four all but
// one, and all pairs.
std::span<const std::uint8_t> looks_in_corner_of(int sides) {
    static constexpr std::uint8_t kTwo[] = {1, 2}, kThree[] = {1, 2, 4, 6, 5, 3},
                                  kFour[] = {1, 2, 4, 8, 14, 13, 11, 7, 3, 5, 6, 9, 10, 12};
    if (sides == 2) return kTwo;
    if (sides == 3) return kThree;
    return sides == 4 ? std::span<const std::uint8_t>(kFour) : std::span<const std::uint8_t>();
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

ProbeContact FieldContact::update(Vec3 probe, std::span<const Vec3> balls_mm) noexcept {
    // What was free for the probe as it was turned is so for the turned one less what that moved.
    const double turned_mm = gap_.set_balls(balls_mm);
    anchor_.radius -= turned_mm;
    return tick(probe, turned_mm);
}

ProbeContact FieldContact::tick(Vec3 probe, double turned_mm) noexcept {
    queries_ = 0;
    searches_before_ = gap_.searches();
    if (!is_finite(probe)) return {};
    if (phase_ == Phase::begin) {
        at_.proxy = rested_mm_ = probe;
        sticking_ = true;
        phase_ = Phase::climb;
        last_probe_ = probe;
        last_force_n_ = 0;
    }
    const bool turned = turned_mm > 0, stood = !settled_ && at_.proxy == last_proxy_;
    last_proxy_ = at_.proxy;
    settled_ = braced_ = moved_ = looked_ = false;
    side_step_.interrupt();
    // What stopped a ball's shortest steps may be no finer than its nearest places are found: once more from
    // far.
    if (stride_mm_ < kLowest) stride_mm_ = gap_.radius_mm() > 0 ? 1e30 : kLowest;
    if (phase_ == Phase::touching && stuck_s_ >= kStuckS) release_stuck_proxy(probe);
    if (turned && phase_ == Phase::touching) (void)push_out();
    // The anchor of a ball that slides has no room of its own.
    if (phase_ == Phase::touching && (turned || gap_.radius_mm() == 0)) renew_anchor();
    if (phase_ == Phase::touching && gap_.radius_mm() == 0 && stood) fetch_anchor();
    for (Next next = Next::more; next == Next::more && budget(kStepQueries);) {
        switch (phase_) {
            case Phase::begin:
            case Phase::climb:
                next = climb();
                break;
            case Phase::free:
                next = fly(probe);
                break;
            case Phase::touching:
                next = slide(probe);
                break;
        }
    }
    if (phase_ == Phase::touching && (!settled_ || braced_)) (void)push_out();
    const bool stuck = phase_ == Phase::touching && (!settled_ || is_wedged()) &&
                       (gap_.radius_mm() > 0 || gap_.balls() > 1) &&
                       distance(at_.proxy, last_proxy_) < kCreeping * distance(at_.proxy, probe);
    stuck_s_ = stuck && measure(probe).gap_mm > kSkin ? stuck_s_ + options_.tick_s : 0;
    sticking_ = distance(at_.proxy, last_proxy_) < options_.stick_mm_per_s * options_.tick_s;
    if (settled_) rested_mm_ = at_.proxy;
    ProbeContact c = answer(probe);
    limit_growth(c, distance(probe, last_probe_) + turned_mm);
    last_probe_ = probe;
    return c;
}

// Before the proxy has settled: the force grows by no more than this motion of the probe explains.
void FieldContact::limit_growth(ProbeContact& c, double moved_mm) {
    const double most_n = last_force_n_ + options_.stiffness_n_per_mm * moved_mm;
    if (!settled_) c.force_n = limited(c.force_n, most_n);
    last_force_n_ = length(c.force_n);
}

// Whether two sides hold the proxy from both sides.
bool FieldContact::is_wedged() const {
    for (int n = 0; n < at_.sides.count; ++n) {
        for (int m = 0; m < n; ++m) {
            if (dot(at_.sides.side[static_cast<std::size_t>(n)].normal,
                    at_.sides.side[static_cast<std::size_t>(m)].normal) < -kOneSide)
                return true;
        }
    }
    return false;
}

void FieldContact::Place::touch(const ProbeGap::Gap& seen) {
    normal = seen.normal;
    piece = seen.piece;
    ball = seen.ball;
    meeting = seen.meeting;
}

FieldContact::Split FieldContact::split(const Place& place, Vec3 probe) const {
    const Vec3 way = probe - place.proxy;
    Split s;
    s.rest = place.sides.nearest(way);
    s.press = way - s.rest;
    s.rest_mm = length(s.rest);
    s.press_mm = length(s.press);
    return s;
}

Vec3 FieldContact::step_for(const Split& way) {
    side_step_.learn(way.rest);
    Vec3 step = side_step_.ease() * way.rest;
    if (at_.sides.count == 1) {
        const std::span meeting(at_.meeting.normal.data(), at_.meeting.count);
        step = meeting.empty() ? side_step_.on_side(way.rest, at_.normal)
                               : side_step_.round_edge(way.rest, meeting, way.press_mm, gap_.radius_mm());
    }
    const double goal = std::max(0.0, 1 - options_.friction_kinetic * way.press_mm / way.rest_mm);
    return limited(goal * step, stride_mm_);
}

// Of normals: how alike a new side of a corner is to be to one of them to take its place. Where it rises out
// of that, as in a hollow or at a shallow valley, the free space is bounded by both.
double FieldContact::alike_in(const contact::HalfSpaces& corner, bool rises) {
    return rises && corner.count > 1 && corner.count < contact::HalfSpaces::kMost ? kApart : kOneSide;
}

// Puts a place onto the surface that was seen from it: down to a side that it stands on alone, into the
// corner of all its sides otherwise. Whether its sides have stayed.
bool FieldContact::correct(Place& place, const ProbeGap::Gap& seen) const {
    const Vec3 landed = place.proxy - seen.gap_mm * seen.normal;
    const bool bends = place.sides.count <= 1 && dot(seen.normal, place.normal) > kOneSide;
    const double alike = alike_in(place.sides, seen.gap_mm < -skin());
    if (bends) {
        place.proxy = landed;
        place.sides = {};
    } else {
        contact::HalfSpaces corner = planes_of(place.sides, place.proxy);
        corner.put({-seen.normal, -dot(seen.normal, landed), 0}, alike);
        place.proxy = corner.nearest(place.proxy);
    }
    place.sides.put(side_of(seen.normal), alike);
    place.touch(seen);
    // What is nearest to a ball in air is so too where it comes down on it.
    place.leap_mm = bends && gap_.radius_mm() > 0 ? std::max(0.0, -seen.gap_mm) : std::abs(seen.gap_mm);
    return bends;
}

// Down from a trial onto the one side that is seen from there.
void FieldContact::land_on_side(Place& to, Vec3 trial, ProbeGap::Gap seen, double size_mm) {
    to.proxy = trial;
    for (int k = 0;; ++k) {
        to.sides = {};
        to.normal = seen.normal;
        (void)correct(to, seen);
        // After a leap in height what was nearest from the trial may not be so where it lands.
        if (k == kMostLandings || to.leap_mm <= kLeap * size_mm + kSkin || !budget(kStepQueries)) return;
        seen = measure(to.proxy);
    }
}

// A step along the surface, and down onto it.
FieldContact::Landing FieldContact::land(const Place& from, Vec3 step, const Split& way, Place& to) {
    const double size = length(step);
    const bool alone = from.sides.count == 1;
    Vec3 trial = from.proxy + step;
    ProbeGap::Gap g = measure(trial);
    if (alone && g.gap_mm < 0 && g.gap_mm > -kLeap * size && dot(g.normal, from.normal) < kOneSide &&
        budget(kStepQueries)) {
        // Hardly below a floor the nearest air may be aside, where a cutter's rim stood for an instant.
        const Vec3 above = trial - 2 * g.gap_mm * from.normal;
        const ProbeGap::Gap seen = measure(above);
        if (dot(seen.normal, from.normal) > kOneSide) {
            trial = above;
            g = seen;
        }
    }
    const double alike = dot(g.normal, from.normal);
    // The proxy would be behind it: not so in a groove as sharp.
    const bool other_side = alike < kOtherSide && size > gap_.radius_mm() && g.gap_mm <= kSkin &&
                            g.gap_mm - dot(g.normal, step) < -kSkin;
    if (alone && (other_side || (alike > kOneSide && g.gap_mm < -kOff * size))) return Landing::none;
    to = from;
    if (g.gap_mm > kOff * size + kSkin) {
        to.proxy = trial;
        return Landing::over_edge;
    }
    // A ball that fills a slot touches its other side too.
    const bool wedged = alike < kOtherSide && g.gap_mm < kLens && gap_.radius_mm() > 0;
    if (alone && g.gap_mm > kSkin && !wedged && alike < kOneSide &&
        dot(from.proxy + way.rest + way.press - trial, g.normal) >= 0) {
        // Off the one side, and the other one does not hold the probe: there is air between them.
        to.proxy = trial;
        return Landing::over_edge;
    }
    if (alone && !wedged && (g.gap_mm > kSkin || alike > kOneSide)) {
        land_on_side(to, trial, g, size);
        return Landing::on_surface;
    }
    const contact::HalfSpace side{-g.normal, -dot(g.normal, trial - g.gap_mm * g.normal), 0};
    const double alike_side = alike_in(from.sides, side.above(from.proxy) < -kLeft * size);
    if (g.gap_mm < -kSkin || alone) {
        // Another side is in the way, or just reached: the proxy stands where all of them meet.
        contact::HalfSpaces corner = planes_of(from.sides, from.proxy);
        corner.put(side, alike_side);
        const Vec3 straight = from.proxy + (size / way.rest_mm) * way.rest;
        to.proxy = corner.nearest(straight);
        // Not between here and the trial: the far side of a wall.
        if (distance(to.proxy, straight) > size + kSkin) return Landing::none;
        const Vec3 probe = from.proxy + way.rest + way.press;
        if (distance(to.proxy, probe) >= distance(from.proxy, probe)) {
            // Up the other side it is no nearer: along the corner, or as far down as that goes.
            const Vec3 start = corner.nearest(from.proxy);
            to.proxy = start + limited(corner.nearest(probe) - start, size);
        }
        if (alone && dot(from.normal, to.proxy - from.proxy) > kHollow * size) {
            // In a hollow the side that was seen is the same one, bent: the other plane holds no longer.
            land_on_side(to, trial, g, size);
            return Landing::on_surface;
        }
        // A side that is far behind by now would hold the proxy where there is air.
        to.sides = {};
        for (int i = 0; i < from.sides.count; ++i) {
            const contact::HalfSpace& h = from.sides.side[static_cast<std::size_t>(i)];
            if (dot(h.normal, to.proxy - from.proxy) > -kOff * size) to.sides.put(h, kApart);
        }
    } else {
        // Along a corner: a side that the step has left is not there, nor one behind which there is air.
        to.proxy = trial - g.gap_mm * g.normal;
        to.sides = {};
        // A ball that rolls over edges comes down as on a circle.
        const double left = kLeft * size + (gap_.radius_mm() > 0 ? size * size / gap_.radius_mm() : 0);
        for (int i = 0; i < from.sides.count; ++i) {
            const contact::HalfSpace& h = from.sides.side[static_cast<std::size_t>(i)];
            if (dot(h.normal, step) > -kLeft * size && dot(h.normal, to.proxy - from.proxy) < left)
                to.sides.put(h, kApart);
        }
    }
    to.sides.put(side_of(g.normal), alike_side);
    to.touch(g);
    to.leap_mm = std::abs(g.gap_mm);
    return Landing::on_surface;
}

// One step along the surface, or the look that ends them.
FieldContact::Next FieldContact::slide(Vec3 probe) {
    const Split way = split(at_, probe);
    if (way.press_mm <= 0) return take_off();  // nothing holds the probe
    const double friction = moved_ ? options_.friction_kinetic : hold();
    if (way.rest_mm <= (friction + kSettled) * way.press_mm + kSkin) return come_to_rest(way);
    return take_step(probe, way);
}

// Held: is there still a surface? In a corner: do all its sides hold?
FieldContact::Next FieldContact::come_to_rest(const Split& way) {
    settled_ = moved_ && at_.sides.count == 1 && at_.leap_mm <= kLeap * way.press_mm + kSkin;
    if (settled_) return Next::nothing;
    const ProbeGap::Gap g = measure(at_.proxy);
    at_.ball = g.ball;
    settled_ = std::abs(g.gap_mm) <= 2 * kSkin;
    if (settled_) return look_behind_sides(way);
    if (g.gap_mm > 0 && !moved_) {
        // From here on, or the flight would end here again.
        (void)chain({at_.proxy, g.gap_mm});
        return take_off();
    }
    Place corrected = at_;
    (void)correct(corrected, g);
    if (corrected.proxy == at_.proxy) {
        // As near to all its sides as they let it come. If it touches none, it takes off in the next tick.
        settled_ = g.gap_mm <= skin();
        return settled_ ? look_behind_sides(way) : Next::nothing;
    }
    moved_ = true;
    if (!tie(corrected)) return Next::nothing;
    at_ = corrected;
    return Next::more;
}

// In a corner, some sides after the others, a tick each, also while it moves: where a little way along the
// others there is no material behind them, they were those of a step too low to hold, or were left, or are
// those of a saddle.
FieldContact::Next FieldContact::look_behind_sides(const Split& way) {
    contact::HalfSpaces& sides = at_.sides;
    if (moved_) looks_ = 0;
    const std::span looks = looks_in_corner_of(sides.count);
    if (looks_ >= static_cast<int>(looks.size())) return Next::nothing;
    const unsigned left_out = looks[static_cast<std::size_t>(next_look_++) % looks.size()];
    ++looks_;
    contact::HalfSpaces others;
    std::array<Vec3, contact::HalfSpaces::kMost> out;
    int count = 0;
    for (int n = 0; n < sides.count; ++n) {
        const contact::HalfSpace& h = sides.side[static_cast<std::size_t>(n)];
        if ((left_out >> n & 1) != 0)
            out[static_cast<std::size_t>(count++)] = h.normal;
        else
            others.put(h, kApart);
    }
    const Vec3 along = count == 1 ? others.nearest(out[0]) : normalized(others.nearest(way.press), Vec3{});
    // So deep behind them that is.
    double behind = 0;
    for (int n = 0; n < count; ++n) behind = std::max(behind, dot(along, out[static_cast<std::size_t>(n)]));
    if (behind < kLeastBehind) return Next::nothing;
    Anchor there{at_.proxy + kLook * along};
    there.radius = measure(there.at).gap_mm;
    if (there.radius < -kOff * kLook * behind) return Next::nothing;
    sides = others;
    at_.normal = up_from(at_);
    // A flight from farther away might come back to here.
    const Vec3 to_probe = way.rest + way.press;
    if (others.nearest(to_probe) == to_probe) {
        if (gap_.radius_mm() > 0) {
            anchor_ = {at_.proxy, 0};
        } else if (there.radius > kSkin && reaches_down(there, at_.proxy, skin())) {
            anchor_ = there;
        }
    }
    settled_ = false;
    moved_ = true;
    // A longer step would see it again from too far.
    stride_mm_ = std::min(stride_mm_, kLook / kShorter);
    return Next::more;
}

FieldContact::Next FieldContact::take_step(Vec3 probe, const Split& way) {
    const Vec3 step = step_for(way);
    const double size = length(step);
    Place to;
    const Landing landing = land(at_, step, way, to);
    chained_mm_ = 0;
    cramping_ = {};
    bool nearer = true;
    if (landing == Landing::over_edge && size <= kBeyond * way.rest_mm) {
        if (chain({to.proxy, clearance_mm(to.proxy, kHighest)})) return take_off();
    } else if (landing == Landing::on_surface) {
        const bool more_sides = to.sides.count > at_.sides.count;
        const double moved = distance(to.proxy, at_.proxy);
        const double gain = squared_length(probe - at_.proxy) - squared_length(probe - to.proxy);
        nearer = gain >= (more_sides ? 0 : kGain * dot(step, way.rest));
        // Another side of the place itself.
        const bool in_corner = more_sides && moved <= skin();
        if ((in_corner && moved <= kSkin) || ((in_corner || nearer) && tie(to))) {
            const bool smooth = at_.sides.count == 1 && to.sides.count == 1 && at_.meeting.count == 0 &&
                                to.meeting.count == 0 && at_.piece == to.piece &&
                                dot(to.normal, at_.normal) > kOneSide;
            const bool same = smooth || (at_.sides.count == 2 && to.sides.count == 2 &&
                                         dot(up_from(at_), up_from(to)) > kOneSide);
            side_step_.take(way.rest, to.proxy - at_.proxy, same, smooth);
            at_ = to;
            moved_ = true;
            stride_mm_ = std::max(stride_mm_, size / kShorter);
            return Next::more;
        }
    } else if (!looked_) {
        // From a place in material every landing is one.
        looked_ = true;
        if (push_out()) return Next::more;
    }
    // Refused: no longer than a chain of free balls came, and a little into what stopped it; or back from a
    // place beyond the nearest one, as far as the way is from there.
    const bool stopped = chained_mm_ > kSkin && chained_mm_ < 0.9 * size;
    const double beyond = nearer ? 0 : -dot(split(to, probe).rest, step) / size;
    if (stopped) {
        stride_mm_ = std::min(1.02 * chained_mm_ + kLowest, 0.9 * size);
    } else if (beyond > 0) {
        stride_mm_ = std::clamp(size - side_step_.ease() * beyond, kShorter * size, kLittleShorter * size);
    } else {
        stride_mm_ = kShorter * size;
    }
    side_step_.interrupt();
    if (stride_mm_ >= skin()) return Next::more;
    if (nearer ? stand_beside(cramping_) : is_valley(to, step)) {
        if (!nearer) at_.sides.put(side_of(to.normal), kApart);
        at_.normal = up_from(at_);
        stride_mm_ = kLook;
        moved_ = true;
        return Next::more;
    }
    // Where the shortest step comes no nearer, the proxy is as near as it can come.
    settled_ = braced_ = !nearer;
    return settled_ && at_.sides.count > 1 ? look_behind_sides(way) : Next::nothing;
}

// What leaves no room over the next places holds a point, too, where that has reached it, or has come a
// little behind it as the anchor's tolerance lets it. Surfaces of one body that cross are no corner of its
// distance. Whether that is near, and there is room beside it.
bool FieldContact::stand_beside(const contact::HalfSpace& side) {
    if (gap_.radius_mm() > 0 || length(side.normal) == 0 || at_.sides.count == contact::HalfSpaces::kMost)
        return false;
    const double behind = side.above(at_.proxy);
    if (behind < -2 * skin() || behind > kLook) return false;
    const Place was = at_;
    const Anchor tied = anchor_;
    contact::HalfSpaces corner = planes_of(at_.sides, at_.proxy);
    corner.put(side, kApart);
    at_.proxy = corner.nearest(at_.proxy);
    at_.sides.put({side.normal, 0, 0}, kApart);
    anchor_.radius = 0;
    if (distance(at_.proxy, was.proxy) <= kLook) renew_anchor();
    if (anchor_.radius > kSkin) return true;
    at_ = was;
    anchor_ = tied;
    return false;
}

// Whether the shortest step has led over the bottom of a valley of two sides that are nearly one.
bool FieldContact::is_valley(const Place& to, Vec3 step) const {
    return at_.sides.count == 1 && to.sides.count == 1 && dot(to.normal, at_.normal) < kCrease &&
           dot(to.normal, step) < 0;
}

// On the side that was seen, held by others too.
void FieldContact::stand_on(const ProbeGap::Gap& seen, const contact::HalfSpaces& others) {
    at_.touch(seen);
    at_.sides = others;
    at_.sides.put(side_of(seen.normal), kOneSide);
}

// Brings a proxy that has come to stand in material (a nearest place was missed, or the probe has turned) out
// along the normals; where that does not do, back to the air that it is tied to or to where it last rested; a
// probe that has turned may find no room near by and is held where it is least deep.
// Whether it stood there, or on another side than was known.
bool FieldContact::push_out() {
    Vec3 least_deep = at_.proxy;
    double depth_mm = 1e30;
    const auto look = [&](Vec3 at) {
        const ProbeGap::Gap g = measure(at);
        if (-g.gap_mm < depth_mm) {
            depth_mm = -g.gap_mm;
            least_deep = at;
        }
        return g;
    };
    const Vec3 start = at_.proxy;
    double far_mm = 1e30;
    for (int n = 0; n < kMostPushes && distance(at_.proxy, start) <= far_mm; ++n) {
        const ProbeGap::Gap g = look(at_.proxy);
        if (n == 0) far_mm = kPushedFar * std::min(-g.gap_mm, kHighest);
        if (g.gap_mm >= -std::max(2 * kSkin, skin())) {
            if (n > 0 || at_.sides.count > 1 || dot(g.normal, up_from(at_)) > kSameSide) return n > 0;
            stand_on(g, {});
            return true;
        }
        at_.proxy -= g.gap_mm * g.normal;
        // After a hardly noticeable push the other sides still hold it.
        stand_on(g, g.gap_mm > -kLens ? at_.sides : contact::HalfSpaces{});
    }
    for (const Vec3 back : {anchor_.at, rested_mm_}) {
        anchor_ = {back, look(back).gap_mm};
        at_.proxy = back;
        phase_ = Phase::free;
        if (anchor_.radius > -kLens) return true;
    }
    at_.proxy = least_deep;
    stand_on(measure(least_deep), {});
    phase_ = Phase::touching;
    return true;
}

ProbeContact FieldContact::answer(Vec3 probe) {
    ProbeContact c;
    c.proxy_mm = at_.proxy;
    c.settled = settled_;
    c.normal = at_.normal;
    c.slip_mm_per_s = (at_.proxy - last_proxy_) / options_.tick_s;
    const Vec3 way = probe - at_.proxy;
    const Split s = split(at_, probe);
    if (phase_ != Phase::touching || (!settled_ && !(s.press_mm > 0))) {
        // On its way through the air: nothing is felt of it unless the probe is in material. As deep as it is
        // there it is pushed back, out of the surface or, where that is the far side of a wall, to the proxy.
        if (settled_) return c;
        const ProbeGap::Gap g = measure(probe);
        if (g.gap_mm >= 0) return c;
        c.in_contact = true;
        c.penetration_mm = std::min(-g.gap_mm, length(way));
        c.normal = dot(g.normal, way) < 0 ? g.normal : -1 * normalized(way, -at_.normal);
        c.force_n = options_.stiffness_n_per_mm * c.penetration_mm * c.normal;
        return c;
    }
    c.penetration_mm = s.press_mm;
    if (!(s.press_mm > 0)) return c;
    c.in_contact = true;
    c.sliding = !sticking_;
    if (at_.sides.count > 1) c.normal = -1 / s.press_mm * s.press;
    // What friction does not hold is the way that a proxy which has settled does not go.
    const double drag = options_.friction_static * s.press_mm;
    const Vec3 held = settled_ && !braced_ && s.rest_mm > drag ? (drag / s.rest_mm) * s.rest : s.rest;
    c.force_n = -options_.stiffness_n_per_mm * (s.press + held);
    c.lever_mm = gap_.offset_mm(at_.ball) - gap_.radius_mm() * at_.normal;
    return c;
}

}  // namespace tribo::haptics
