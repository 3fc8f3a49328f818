// SPDX-License-Identifier: MIT
// A god-object on a distance field (Zilles and Salisbury 1995; friction cones: Harwin and Melder 2002): the
// proxy stays in the air while the probe enters the material, and a spring between the two is what the hand
// feels.
#pragma once

#include <span>

#include "contact/distance_field.hpp"
#include "contact/half_spaces.hpp"
#include "haptics/probe_gap.hpp"

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

// The proxy never crosses the surface, however fast the probe goes and however thin a wall is: it is tied to
// an anchor, the centre of a ball that is known to be free, and an anchor is only moved to a ball that
// overlaps the one before (or a chain of such). What does not fit into a tick's budget goes on in the next.
//
// The proxy is where the distance to the probe is least, found by sliding along the surface with the step
// that its curvature allows; in a corner it is held by all its sides. Depends on no mesh and no unit.
//
// One thread at a time. update() is real-time safe: no allocation, lock, exception or output, at most
// kMostQueries queries of the field (times the balls of a shell).
class FieldContact {
  public:
    static constexpr int kMostQueries = 48;

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
    int queries() const { return static_cast<int>(gap_.queries() - first_query_); }

  private:
    enum class Phase { begin, climb, free, touching };
    // A place known to be free, and how far around it.
    struct Anchor {
        Vec3 at;
        double radius = 0;
    };
    struct Slide {
        Vec3 proxy, normal;
        contact::HalfSpaces sides;
        std::size_t ball = 0;
        Vec3 rest;            // of the way to the probe, along the surface
        double press_mm = 0;  // of the way to the probe, into the surface
        bool settled = false;
        bool lost = false;  // no surface where one was
    };

    Contact tick(Vec3 probe, bool turned) noexcept;
    void climb(Vec3 probe);
    void fly(Vec3 probe);
    void slide(Vec3 probe);
    Slide slide_from_proxy(Vec3 probe, double longest_step);
    bool land(Slide& s);
    Vec3 along(const Slide& s, Vec3 way) const;
    static contact::HalfSpaces corner_of(const Slide& s, Vec3 point, Vec3 normal);
    bool tie(const Slide& s);
    bool chain(const Anchor& to);
    void anchor_here();
    bool freed(Vec3 probe);
    Contact answer(Vec3 probe) const;
    bool budget(int queries) const { return gap_.queries() + queries <= first_query_ + kMostQueries; }
    double hold() const { return sticking_ ? options_.friction_static : options_.friction_kinetic; }

    const contact::DistanceField* field_;
    ContactOptions options_;
    ProbeGap gap_;
    long first_query_ = 0;
    Phase phase_ = Phase::begin;
    bool sticking_ = true;
    bool stuck_ = false;  // the last tick found no way on
    Anchor anchor_;
    Slide at_;  // the contact
    Vec3 last_proxy_;
    double ease_ = 1;      // step along the surface for a unit of rest: 1 on a plane, less in a hollow
    double height_ = 0.1;  // of the anchor over the proxy, mm
};

}  // namespace tribo::haptics
