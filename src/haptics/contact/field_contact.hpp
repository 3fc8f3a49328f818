// SPDX-License-Identifier: MIT
// God-object contact on a distance field (Zilles and Salisbury 1995; friction cones: Harwin and Melder 2002).
// The proxy stays outside of the material while the probe enters it. The hand feels a spring between proxy
// and probe.
#pragma once

#include <cmath>
#include <span>

#include "contact/distance_field.hpp"
#include "contact/half_spaces.hpp"
#include "haptics/contact/probe_gap.hpp"
#include "haptics/contact/side_step.hpp"

namespace tribo::haptics {

struct ContactOptions {
    double stiffness_n_per_mm = 0.5;  // > 0
    double probe_radius_mm = 0;       // >= 0; 0: a point
    // Coulomb friction coefficients: the proxy sticks up to `static` and slides with `kinetic`.
    // 0 <= kinetic <= static.
    double friction_static = 0;
    double friction_kinetic = 0;
    // A sliding proxy sticks again below this speed. Slower motion feels like stick-slip, faster motion like
    // a steady drag.
    double stick_mm_per_s = 10;
    double tick_s = 1e-3;  // between two updates, > 0
};

struct ProbeContact {
    Vec3 force_n;          // on the probe
    Vec3 proxy_mm;         // position of the proxy
    Vec3 normal{0, 0, 1};  // surface normal at the proxy, unit; without contact the last one
    Vec3 slip_mm_per_s;    // of the proxy along the surface
    bool in_contact = false;
    bool sliding = false;       // in contact and not held by friction
    bool settled = true;        // the proxy is at rest; otherwise the next tick moves it on
    double penetration_mm = 0;  // of the probe, along the surface normals
    // From the probe position to the point of contact. The torque is lever x force, N mm.
    Vec3 lever_mm;
};

// The proxy never crosses the surface, at any speed of the probe and any thickness of a wall. Five rules hold
// in every tick:
//   1. The proxy is tied: it touches a ball of free space (the anchor). A chain of free balls joins each
//      anchor to the one before. A ball is tied without one by the last place, where a step is so short that
//      nothing can be between the two.
//   2. The proxy steps along the surface only if the step brings it nearer to the probe and the new place can
//      be tied.
//   3. The proxy makes progress: after a refused step it tries a shorter one, in this tick or in the next.
//   4. Before the proxy has settled, the whole spring acts from the last tied place. In flight, and where the
//      place does not hold the probe, only the part of the spring that the depth of the probe explains acts.
//   5. Before the proxy has settled, the force grows by no more than the motion of the probe explains.
//
// The proxy minimises the distance to the probe. It slides along the surface with a step that the curvature
// allows. In a corner all sides hold it. No mesh and no unit is assumed.
//
// One thread at a time. update() is real-time safe: no allocation, lock, exception or output. It makes at
// most kMostQueries queries of the field (times the number of balls of a shell).
class FieldContact {
  public:
    static constexpr int kMostQueries = 116;

    // `field` must outlive the contact or be replaced.
    explicit FieldContact(const contact::DistanceField& field, const ContactOptions& options = {});

    // One tick with the probe at `probe_mm`. If the position is not finite the proxy stays and the force is
    // 0.
    ProbeContact update(Vec3 probe_mm) noexcept { return tick(probe_mm, 0); }
    // The same for a probe of several balls (ProbeGap). `balls_mm` are their current offsets from the probe
    // position.
    ProbeContact update(Vec3 probe_mm, std::span<const Vec3> balls_mm) noexcept;

    // Restarts with the next update. A probe in air is free; a probe in material gets a proxy on the nearest
    // surface.
    void reset();
    // Replaces the field by one with material removed. The contact continues.
    void set_field(const contact::DistanceField& field) { field_ = &field; }
    void set_options(const ContactOptions& options);
    const ContactOptions& options() const { return options_; }
    // Of the last update.
    int queries() const { return queries_; }

  private:
    enum class Phase { begin, climb, free, touching };
    // Whether this tick has more work.
    enum class Next { nothing, more };
    // Centre and radius of a ball of free space.
    struct Anchor {
        Vec3 at;
        double radius = 0;
    };
    // Of the most: kept for the end of a tick, which pushes a proxy out of the material and asks where the
    // probe is.
    static constexpr int kEndQueries = 20;
    // After so many searches along the surface (NearHint) a tick makes only the queries of its end. A ball
    // about as wide as the cutter was needs many. kFirst: until it has taken a step. kFlight: in flight,
    // where the hand feels nothing of the way still to go.
    static constexpr long kMostSearches = 80, kFirstSearches = 120, kFlightSearches = 160;
    // Queries that a step may need before it can be taken back, and links of a chain of balls.
    static constexpr int kStepQueries = 6, kMostLinks = 24;
    // A proxy within this of the surface is on it, mm. No shorter step is worth taking. Of a ball the field
    // finds the nearest place within 2e-5.
    static constexpr double kSkin = 1e-6, kBallSkin = 4e-5;
    // Material may be so deep in the way of a ball between two places of it, mm.
    static constexpr double kLens = 5e-4;
    // Normals within about 18 degrees are one side that bends; beyond, two sides that meet.
    static constexpr double kOneSide = 0.95;
    // No two normals are as alike: every side is one of its own.
    static constexpr double kApart = 2;
    // A refused step is followed by one of this share.
    static constexpr double kShorter = 0.25;
    static constexpr double kLowest = 1e-4, kHighest = 0.5;  // height of the anchor, mm
    // A place of the proxy on the surface.
    struct Place {
        Vec3 proxy, normal{0, 0, 1};
        contact::HalfSpaces sides;  // sides that hold the proxy; offsets 0
        std::uint32_t piece = 0;    // of the surface
        std::size_t ball = 0;       // the ball of the probe that touches
        ProbeGap::Gap::Meeting meeting;
        double leap_mm = 0;  // correction by the last query

        void touch(const ProbeGap::Gap& seen);
    };
    // The way from the proxy to the probe, split into a part along the surface and a part into it.
    struct Split {
        Vec3 rest, press;
        double rest_mm = 0, press_mm = 0;
    };

    ProbeContact tick(Vec3 probe, double turned_mm) noexcept;
    bool is_wedged() const;
    bool is_open(Vec3 from, Vec3 to);
    void release_stuck_proxy(Vec3 probe);
    Next climb();
    Next fly(Vec3 probe);
    void lift(Anchor& ball, Vec3 up, double height_mm);
    void touch_down(Vec3 probe, Anchor from, ProbeGap::Gap seen);
    Next slide(Vec3 probe);
    Split split(const Place& place, Vec3 probe) const;
    Next take_off();
    Next come_to_rest(const Split& way);
    Next look_behind_sides(const Split& way);
    Next take_step(Vec3 probe, const Split& way);
    Vec3 step_for(const Split& way);
    enum class Landing { on_surface, over_edge, none };
    Landing land(const Place& from, Vec3 step, const Split& way, Place& to);
    bool correct(Place& place, const ProbeGap::Gap& seen) const;
    static double alike_in(const contact::HalfSpaces& corner, bool rises);
    bool is_valley(const Place& to, Vec3 step) const;
    bool stand_beside(const contact::HalfSpace& side);
    void land_on_side(Place& to, Vec3 trial, ProbeGap::Gap seen, double size_mm);
    void stand_on(const ProbeGap::Gap& seen, const contact::HalfSpaces& others);
    bool push_out();
    void renew_anchor();
    void fetch_anchor();
    void raise_anchor(double height_mm);
    static Vec3 up_from(const Place& place);
    bool tie(const Place& to);
    bool chain(const Anchor& to);
    bool reaches_down(Anchor ball, Vec3 proxy, double tolerance_mm);
    ProbeContact answer(Vec3 probe);
    void limit_growth(ProbeContact& contact, double moved_mm);
    bool budget(int queries) const {
        const long most = phase_ != Phase::touching ? kFlightSearches
                          : moved_                  ? kMostSearches
                                                    : kFirstSearches;
        return queries_ + queries <= kMostQueries - kEndQueries && gap_.searches() - searches_before_ < most;
    }
    ProbeGap::Gap measure(Vec3 at) {
        ++queries_;
        return gap_.measure(*field_, at);
    }
    double clearance_mm(Vec3 at, double enough_mm, bool over_touch = false) {
        ++queries_;
        return gap_.clearance_mm(*field_, at, enough_mm, over_touch);
    }
    // Between two free places of a ball so far apart nothing is deeper in its way than kLens: the two balls
    // leave out a lens of that depth. A point: 0.
    double bridge_mm() const { return std::sqrt(8 * gap_.radius_mm() * kLens); }
    double skin() const { return gap_.radius_mm() > 0 ? kBallSkin : kSkin; }
    double hold() const { return sticking_ ? options_.friction_static : options_.friction_kinetic; }

    const contact::DistanceField* field_;
    ContactOptions options_;
    ProbeGap gap_;
    int queries_ = 0;
    long searches_before_ = 0;  // before this tick
    Phase phase_ = Phase::begin;
    bool settled_ = true;
    bool braced_ = false;  // settled between nearly parallel sides, which also hold the remaining way
    bool sticking_ = true;
    bool moved_ = false, looked_ = false;  // in this tick: a step was taken; the place was examined
    // Of the corner in which the proxy has settled: how many looks behind its sides were done there, and
    // which is next.
    int looks_ = 0, next_look_ = 0;
    Anchor anchor_;
    double chained_mm_ = 0;  // length of the last chain
    bool misled_ = false;    // the last one from the anchor did not lead to where it should
    // What last left no room over a place of the proxy; its normal is 0: nothing did.
    contact::HalfSpace cramping_;
    Place at_;        // the contact, tied
    Vec3 rested_mm_;  // the proxy when it last settled
    // Of the last tick.
    Vec3 last_proxy_, last_probe_;
    double last_force_n_ = 0;
    SideStep side_step_;
    double height_ = 0.1;   // of the anchor over the proxy, mm
    double stride_mm_ = 0;  // longest step that is tried
    double stuck_s_ = 0;    // time without motion of the proxy although the probe is in air
};

}  // namespace tribo::haptics
