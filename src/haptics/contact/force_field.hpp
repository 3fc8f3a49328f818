// SPDX-License-Identifier: MIT
// Force field around a cutter ("Haptic and aural rendering of a virtual milling process", sections 3.2
// and 4.1: FEMForceField). F = F_fem + F_tex: the cutting force and the texture of the grooves. Both fade
// with the distance between the cylinders of finger and cutter. field_contact.hpp computes the contact with
// the surface (F_reaction).
#pragma once

#include "base/vec3.hpp"
#include "contact/texture_record.hpp"

namespace tribo::haptics {

// A cylinder: centre of the lower end, axis (unit, towards the upper end), radius and length.
struct Cylinder {
    Vec3 end_mm;
    Vec3 axis{0, 0, 1};
    double radius_mm = 0;
    double length_mm = 0;
};

// Distance between two cylinders with rounded ends: distance of the axis segments minus the radii. Negative
// if they overlap. Exact for the segments (Ericson 2005, 5.1.9).
double cylinder_distance_mm(const Cylinder& a, const Cylinder& b);

// Cutting force as a function of time, for example from a force table or a recording. Real-time safe.
class CuttingForce {
  public:
    virtual ~CuttingForce() = default;
    // Force on the cutter at time `at_s`, stock frame, scaled for the hand.
    virtual Vec3 force_n(double at_s) noexcept = 0;
};

struct ForceFieldOptions {
    // Distances between finger and cutter: full force up to `near_mm`, no force from `far_mm` on, a smooth
    // fade between.
    double near_mm = 2, far_mm = 10;  // 0 <= near < far
    double switch_s = 0.1;            // fade time of the switch; > 0
    double texture_stiffness_n_per_mm = 0.5;
    double texture_press_mm = 0.2;  // assumed penetration: near the cutter none is measured
    double tick_s = 1e-3;
};

// Input of one tick.
struct ForceFieldInput {
    double at_s = 0;
    Cylinder cutter;
    Cylinder finger;                                  // end_mm is the probe position
    const contact::TextureRecord* texture = nullptr;  // at the cutter position; null: none
};

struct FieldForce {
    Vec3 cutting_n;       // F_fem, faded and switched
    Vec3 texture_n;       // F_tex, faded and switched
    double nearness = 0;  // of finger and cutter: 0 ... 1
    Vec3 total_n() const { return cutting_n + texture_n; }
};

// One thread; render() is real-time safe. The force has no steps: it fades over switch_s and over the
// distance.
class ForceField {
  public:
    // `cutting` must outlive the field.
    ForceField(CuttingForce& cutting, const ForceFieldOptions& options)
        : options_(options), cutting_(cutting) {}

    // Switches the cutting force on or off; initially on.
    void switch_cutting(bool on) { cutting_on_ = on; }

    FieldForce render(const ForceFieldInput& moment) noexcept;

  private:
    ForceFieldOptions options_;
    CuttingForce& cutting_;
    bool cutting_on_ = true;
    double way_ = 1;  // state of the switch, 0 off to 1 on
    Vec3 last_cutter_;
    bool begun_ = false;
};

}  // namespace tribo::haptics
