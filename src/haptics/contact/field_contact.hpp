// SPDX-License-Identifier: MIT
// A god-object on a distance field (Zilles and Salisbury 1995; friction cones: Harwin and Melder 2002): the
// proxy stays in the air while the probe enters the material, and a spring between the two is what the hand
// feels.
#pragma once

#include <span>

#include "contact/distance_field.hpp"
#include "contact/half_spaces.hpp"
#include "haptics/contact/probe_gap.hpp"

namespace tribo::haptics {

struct ContactOptions {
    double stiffness_n_per_mm = 0.5;  // > 0
    double probe_radius_mm = 0;       // >= 0; 0: a point
    // Coulomb's cones: held up to `static`, pulled along at `kinetic` (0 <= kinetic <= static).
    double friction_static = 0;
    double friction_kinetic = 0;
    // A proxy that is pulled along slower than this sticks again: below it one feels stick-slip, above it a
    // steady drag.
    double stick_mm_per_s = 10;
    double tick_s = 1e-3;  // between two updates, > 0
};

struct Contact {
    Vec3 force_n;          // on the probe
    Vec3 proxy_mm;         // where the probe would be if the surface held it
    Vec3 normal{0, 0, 1};  // of the surface at the proxy, unit; the last one while there is no contact
    Vec3 slip_mm_per_s;    // of the proxy along the surface
    bool in_contact = false;
    bool sliding = false;       // in contact and not held by friction
    bool settled = true;        // the proxy has come to rest; else it goes on with the next tick
    double penetration_mm = 0;  // of the probe, along the surface's normals
    // Where on the probe it touches: torque about the probe's position is lever x force, N mm.
    Vec3 lever_mm;
};

// The proxy never crosses the surface, however fast the probe goes and however thin a wall is. Four things
// hold in every tick:
//   1. The proxy is tied: it touches a ball that is known to be free (the anchor), and each anchor is joined
//      to the one before by free balls.
//   2. A step along the surface is taken only where it brings the proxy nearer to the probe and its place can
//      be tied.
//   3. It progresses: a step that is refused is followed by a shorter one, in this tick or in the next.
//   4. Until the proxy has settled the whole spring acts, from the last place that was tied; in flight, what
//      of it the probe's depth explains.
//
// The proxy is where the distance to the probe is least, found by sliding along the surface with the step
// that its curvature allows; in a corner it is held by all its sides. Depends on no mesh and no unit.
//
// One thread at a time. update() is real-time safe: no allocation, lock, exception or output, at most
// kMostQueries queries of the field (times the balls of a shell).
class FieldContact {
  public:
    static constexpr int kMostQueries = 96;

    // `field` must outlive the contact or be replaced.
    explicit FieldContact(const contact::DistanceField& field, const ContactOptions& options = {});

    // One tick: the probe is at `probe_mm` now. Not finite: nothing moves, no force.
    Contact update(Vec3 probe_mm) noexcept;
    // The same for a probe of several balls (ProbeGap), by their offsets from the probe's position as it is
    // turned now.
    Contact update(Vec3 probe_mm, std::span<const Vec3> balls_mm) noexcept;

    // Begins anew with the next update: a probe that is in air is free, one in material is first brought to
    // the surface near it.
    void reset();
    // The same surface with material removed; the contact goes on.
    void set_field(const contact::DistanceField& field) { field_ = &field; }
    void set_options(const ContactOptions& options);
    const ContactOptions& options() const { return options_; }
    // Of the last update.
    int queries() const { return queries_; }

  private:
    enum class Phase { begin, climb, free, touching };
    // What is left to do in this tick.
    enum class Next { nothing, more };
    // A place known to be free, and how far around it.
    struct Anchor {
        Vec3 at;
        double radius = 0;
    };
    // On the surface.
    struct Place {
        Vec3 proxy, normal{0, 0, 1};
        contact::HalfSpaces sides;  // that hold the proxy; offsets 0
        std::size_t ball = 0;       // of the probe, that touches
        double leap_mm = 0;         // by how much the last look had to correct it
    };
    // Of the way from the proxy to the probe: what leads along the surface and what into it.
    struct Split {
        Vec3 rest, press;
        double rest_mm = 0, press_mm = 0;
    };
    // The last step on a smooth side, and what was left to go before it.
    struct Step {
        Vec3 rest, way;
        bool known = false;
    };

    Contact tick(Vec3 probe, bool turned) noexcept;
    void let_go_of_the_stuck(Vec3 probe);
    Next climb();
    Next fly(Vec3 probe);
    void lift(Anchor& ball, Vec3 up, double height_mm);
    void touch_down(Vec3 probe, Anchor from, ProbeGap::Gap seen);
    Next slide(Vec3 probe);
    Split split(const Place& place, Vec3 probe) const;
    Next take_off();
    Next come_to_rest(const Split& way);
    Next look_behind_a_side();
    Next take_step(Vec3 probe, const Split& way);
    Vec3 step_for(const Split& way);
    enum class Landing { on_surface, over_edge, none };
    Landing land(const Place& from, Vec3 step, Place& to);
    bool correct(Place& place, const ProbeGap::Gap& seen) const;
    bool push_out();
    void renew_anchor();
    static Vec3 up_from(const Place& place);
    bool tie(const Place& to);
    bool chain(const Anchor& to);
    bool reaches_down(Anchor ball, Vec3 proxy, double tolerance_mm);
    Contact answer(Vec3 probe);
    bool budget(int queries) const { return queries_ + queries <= kMostQueries; }
    ProbeGap::Gap measure(Vec3 at) {
        ++queries_;
        return gap_.measure(*field_, at);
    }
    double clearance_mm(Vec3 at, double enough_mm) {
        ++queries_;
        return gap_.clearance_mm(*field_, at, enough_mm);
    }
    double hold() const { return sticking_ ? options_.friction_static : options_.friction_kinetic; }

    const contact::DistanceField* field_;
    ContactOptions options_;
    ProbeGap gap_;
    int queries_ = 0;
    Phase phase_ = Phase::begin;
    bool settled_ = true;
    bool braced_ = false;  // settled between sides too alike to be told apart, which hold the rest too
    bool sticking_ = true;
    bool moved_ = false, looked_ = false;  // in this tick: a step was taken, the place was looked at
    Step last_step_;
    int looked_sides_ = 0;  // of the corner in which the proxy has settled
    Anchor anchor_;
    double chained_mm_ = 0;  // how far the last chain came
    Place at_;               // the contact, tied
    Vec3 last_proxy_;
    double ease_ = 1;       // step along the surface for a unit of rest: 1 on a plane, less in a hollow
    double height_ = 0.1;   // of the anchor over the proxy, mm
    double stride_mm_ = 0;  // longest step that is tried
    double stuck_s_ = 0;    // for so long it has not moved, though it should, and the probe was in air
};

}  // namespace tribo::haptics
