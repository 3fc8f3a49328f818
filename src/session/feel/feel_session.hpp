// SPDX-License-Identifier: MIT
// Force sources for the servo: contact with a milled part, and the cutting force near the cutter.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "contact/distance_field.hpp"
#include "haptics/contact/field_contact.hpp"
#include "haptics/contact/force_field.hpp"
#include "haptics/contact/probe_shape.hpp"
#include "haptics/servo/safety.hpp"
#include "haptics/servo/servo.hpp"
#include "haptics/texture/haptic_texture.hpp"
#include "session/cut/cut_record.hpp"
#include "session/feel/surface_waves.hpp"

namespace tribo::session {

// Contact of the probe with a surface: F_reaction = k N_sur from a god-object (section 3.2 of the paper). One
// thread; update() is real-time safe.
class SurfaceContact {
  public:
    // `surface` must outlive this object. It may change between updates.
    SurfaceContact(const contact::DistanceField& surface, const haptics::ContactOptions& options,
                   haptics::ProbeShape probe = {})
        : contact_(surface, options), probe_(std::move(probe)) {}

    haptics::ProbeContact update(const haptics::HandReading& hand) noexcept;
    // The next update starts a new contact at the position of the hand.
    void reset() noexcept { contact_.reset(); }

  private:
    haptics::FieldContact contact_;
    haptics::ProbeShape probe_;
    std::array<Vec3, haptics::ProbeGap::kMostBalls> balls_{};
};

// Inspect mode: contact with the finished part.
class InspectSource final : public haptics::ForceSource {
  public:
    // `surface` must outlive this object and must not change; so must `waves`, what bending left on it, if
    // any.
    InspectSource(const contact::DistanceField& surface, const haptics::ContactOptions& options,
                  haptics::ProbeShape probe = {}, const surface::FormError* waves = nullptr)
        : touch_(surface, options, std::move(probe)) {
        if (waves != nullptr) waves_.emplace(*waves, options.stiffness_n_per_mm);
    }

    haptics::RenderedForce render(const haptics::HandReading& hand, double now_s,
                                  double tick_s) noexcept override;

  private:
    SurfaceContact touch_;
    std::optional<SurfaceWaves> waves_;
};

// Position of the cutter as a function of program time. Real-time safe; any thread.
// A cutter with a profile counts as the cylinder around it.
class CutterTrack {
  public:
    // `setup` has not run yet.
    explicit CutterTrack(const MillSetup& setup);
    haptics::Cylinder at(double t_s) const noexcept;

  private:
    std::vector<motion::Move> moves_;
    std::shared_ptr<const motion::Schedule> schedule_;
    std::vector<std::size_t> cutter_of_move_;
    std::vector<haptics::Cylinder> cutters_;  // radius and length
};

// Force near the moving cutter: F_fem + F_tex (section 3.2 of the paper). One thread; render() is real-time
// safe.
class CutterForceRenderer {
  public:
    // `force` must outlive this object. `finger_mm`: radius of the finger cylinder.
    CutterForceRenderer(haptics::CuttingForce& force, double finger_mm, double tick_s);

    void switch_cutting(bool on) { field_.switch_cutting(on); }
    // `at_s`: program time. `textures`: null for none.
    haptics::FieldForce render(const haptics::HandReading& hand, double at_s, const CutterTrack& track,
                               const haptics::TextureMap* textures) noexcept;

  private:
    double finger_mm_;
    haptics::ForceField field_;
};

// Texture records along the cut, at least `spacing_mm` of path apart.
haptics::TextureMap texture_map(std::span<const milling::CutRow> cut, const contact::DistanceField& machined,
                                const ParallelFor& parallel, double spacing_mm = 2);

struct CutSourceOptions {
    double start_s = 0;    // program time at servo time 0
    double finger_mm = 0;  // radius of the finger's cylinder
    double tick_s = 1e-3;
    bool texture = true;
    // The part while it is milled; must outlive the source. Null: no contact with the part.
    field::FieldReader* part = nullptr;
    haptics::ContactOptions contact{};  // with `part`
    haptics::ProbeShape probe{};
};

// Cut mode: the force near the cutter while the program runs, and contact with the part as milled so far.
class CutSource final : public haptics::ForceSource {
  public:
    // All arguments must outlive this object. There is no force outside of the force table.
    CutSource(const CutterTrack& track, haptics::CuttingForce& force, const haptics::TextureMap& textures,
              const CutSourceOptions& options);

    haptics::RenderedForce render(const haptics::HandReading& hand, double now_s,
                                  double tick_s) noexcept override;

  private:
    const CutterTrack& track_;
    const haptics::TextureMap& textures_;
    CutSourceOptions options_;
    CutterForceRenderer cutter_force_;
    std::optional<SurfaceContact> touch_;
};

// Safety limits of a device, from its own data. A device without motors gets no ramp, and a slew limit that
// does not change the force of a tooth.
haptics::SafetyLimits safety_limits(const haptics::Device& device, double rate_hz);

}  // namespace tribo::session
