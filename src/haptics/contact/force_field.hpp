// SPDX-License-Identifier: MIT
// The force that a hand meets near a cutter ("Haptic and aural rendering of a virtual milling process", 3.2
// and 4.1: FEMForceField): inside a volume about the cutter the cutting force and the texture of the grooves;
// when cutting is switched off, the machined surface itself.
//
//   cut:      F = F_fem + F_tex,       faded by the distance between the finger's and the cutter's cylinder
//   inspect:  F = F_reaction + F_tex,  F_reaction = k N_sur: contact with the surface, at any place
#pragma once

#include "haptics/contact/field_contact.hpp"
#include "haptics/texture/haptic_texture.hpp"
#include "haptics/texture/vibration.hpp"

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

enum class FeelMode { cut, inspect };

struct ForceFieldOptions {
    // The cutting force is felt in full up to `near_mm` between finger and cutter, not at all from `far_mm`
    // on, smoothly less between: far_mm is the field's bounding volume.
    double near_mm = 2, far_mm = 10;  // 0 <= near < far
    double switch_s = 0.1;            // that turning cutting on or off, or changing mode, takes; > 0
    double texture_stiffness_n_per_mm = 0.5;
    double texture_press_mm = 0.2;  // in cut mode, where nothing says how hard the hand presses
    // In inspect mode the contact is with the real grooves; the texture adds to them: 0 leaves them as they
    // are.
    double texture_gain_cut = 1, texture_gain_inspect = 0;
    double tick_s = 1e-3;
};

// What is around the hand at this tick. Null: nothing of the kind.
struct FieldMoment {
    double at_s = 0;
    Cylinder cutter;
    Cylinder finger;                                  // end_mm is the probe's position
    const contact::TextureRecord* texture = nullptr;  // of the cutter's position
};

struct FieldForce {
    Vec3 cutting_n;       // F_fem, faded and switched
    Vec3 surface_n;       // F_reaction with friction, switched
    Vec3 texture_n;       // F_tex and the vibration that rides on it
    double lent_nmm = 0;  // energy that the surface gets in this tick as it is faded in, and loses as it goes
    double nearness = 0;  // of finger and cutter: 0 ... 1
    bool in_contact = false;
    Vec3 total_n() const { return cutting_n + surface_n + texture_n; }
};

// One thread; render() is real-time safe. No force steps: modes and switch fade over switch_s, the volume's
// border by the distance.
class ForceField {
  public:
    explicit ForceField(const ForceFieldOptions& options) : options_(options) {}

    // What may be there; each must live as long as the field, or be replaced. Null: none.
    void set_cutting(CuttingForce* force) { cutting_ = force; }
    void set_contact(FieldContact* contact) { contact_ = contact; }
    void set_textures(const TextureMap* textures) { textures_ = textures; }
    void set_vibration(Vibration* vibration) { vibration_ = vibration; }

    void set_mode(FeelMode mode) { mode_ = mode; }
    // Begins in a mode instead of fading it in: for whoever fades the whole force, or has no motors.
    void begin_in(FeelMode mode) {
        mode_ = mode;
        cut_.way = mode == FeelMode::cut ? 1 : 0;
        inspect_.way = 1 - cut_.way;
    }
    // The user's switch for the cutting force.
    void switch_cutting(bool on) { cutting_on_ = on; }
    FeelMode mode() const { return mode_; }

    FieldForce render(const FieldMoment& moment) noexcept;
    // The contact of the last render.
    const Contact& contact() const { return touch_; }

  private:
    // Goes from 0 to 1 and back in switch_s; its output is smooth.
    struct Fader {
        double way = 0;
        double step(bool on, double share);
    };

    ForceFieldOptions options_;
    CuttingForce* cutting_ = nullptr;
    FieldContact* contact_ = nullptr;
    const TextureMap* textures_ = nullptr;
    Vibration* vibration_ = nullptr;
    FeelMode mode_ = FeelMode::cut;
    bool cutting_on_ = true;
    Fader cut_, inspect_;
    Contact touch_;
    Vec3 last_cutter_;
    bool begun_ = false;
};

}  // namespace tribo::haptics
