// SPDX-License-Identifier: MIT
// The force that a hand meets near a cutter ("Haptic and aural rendering of a virtual milling process", 3.2
// and 4.1: FEMForceField): inside a volume about the cutter F = F_fem + F_tex, the cutting force and the
// texture of the grooves, faded by the distance between the finger's and the cutter's cylinder. Contact with
// the surface (F_reaction) is field_contact.hpp.
#pragma once

#include "base/vec3.hpp"
#include "contact/texture_record.hpp"

namespace tribo::haptics {

// A cylinder by the middle of its lower end, its axis (unit, towards the upper end), radius and length.
struct Cylinder {
    Vec3 end_mm;
    Vec3 axis{0, 0, 1};
    double radius_mm = 0;
    double length_mm = 0;
};

// Between the surfaces of two cylinders whose ends count as rounded: distance of the axes less the radii;
// negative where they overlap. Exact for the segments (Ericson 2005, 5.1.9).
double cylinder_distance_mm(const Cylinder& a, const Cylinder& b);

// The cutting force as time goes on: from a table of spectra, a recording, anything. Real-time safe.
class CuttingForce {
  public:
    virtual ~CuttingForce() = default;
    // On the cutter, stock frame, already scaled for the hand; `at_s` is the moment that is rendered.
    virtual Vec3 force_n(double at_s) noexcept = 0;
};

struct ForceFieldOptions {
    // The cutting force is felt in full up to `near_mm` between finger and cutter, not at all from `far_mm`
    // on, smoothly less between: far_mm is the field's bounding volume.
    double near_mm = 2, far_mm = 10;  // 0 <= near < far
    double switch_s = 0.1;            // that turning cutting on or off takes; > 0
    double texture_stiffness_n_per_mm = 0.5;
    double texture_press_mm = 0.2;  // near the cutter nothing says how hard the hand presses
    double tick_s = 1e-3;
};

// What is around the hand at this tick.
struct FieldMoment {
    double at_s = 0;
    Cylinder cutter;
    Cylinder finger;                                  // end_mm is the probe's position
    const contact::TextureRecord* texture = nullptr;  // of the cutter's position; null: none
};

struct FieldForce {
    Vec3 cutting_n;       // F_fem, faded and switched
    Vec3 texture_n;       // F_tex, likewise
    double nearness = 0;  // of finger and cutter: 0 ... 1
    Vec3 total_n() const { return cutting_n + texture_n; }
};

// One thread; render() is real-time safe. No force steps: the switch fades over switch_s, the volume's border
// by the distance.
class ForceField {
  public:
    // `cutting` must outlive the field.
    ForceField(CuttingForce& cutting, const ForceFieldOptions& options)
        : options_(options), cutting_(cutting) {}

    // The user's switch for the cutting force; on at first.
    void switch_cutting(bool on) { cutting_on_ = on; }

    FieldForce render(const FieldMoment& moment) noexcept;

  private:
    ForceFieldOptions options_;
    CuttingForce& cutting_;
    bool cutting_on_ = true;
    double way_ = 1;  // of the switch: 0 off, 1 on
    Vec3 last_cutter_;
    bool begun_ = false;
};

}  // namespace tribo::haptics
