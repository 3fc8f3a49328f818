// SPDX-License-Identifier: MIT
// What a hand feels of a milled part and of its cut: the sources of force that a servo asks, made from a run.
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

namespace tribo::session {

// Contact of what the hand holds with a surface: F_reaction = k N_sur from a god-object on it (the paper's
// section 3.2). One thread; update() is real-time safe.
class SurfaceTouch {
  public:
    // `surface` must outlive this. It may change between updates.
    SurfaceTouch(const contact::DistanceField& surface, const haptics::ContactOptions& options,
                 haptics::ProbeShape probe = {})
        : contact_(surface, options), probe_(std::move(probe)) {}

    haptics::ProbeContact update(const haptics::HandReading& hand) noexcept;
    // The next update begins at the hand's place.
    void reset() noexcept { contact_.reset(); }

  private:
    haptics::FieldContact contact_;
    haptics::ProbeShape probe_;
    std::array<Vec3, haptics::ProbeGap::kMostBalls> balls_{};
};

// Inspect mode: the finished part.
class InspectSource final : public haptics::ForceSource {
  public:
    // `surface` must outlive this and stay as it is.
    InspectSource(const contact::DistanceField& surface, const haptics::ContactOptions& options,
                  haptics::ProbeShape probe = {})
        : touch_(surface, options, std::move(probe)) {}

    haptics::RenderedForce render(const haptics::HandReading& hand, double now_s,
                                  double tick_s) noexcept override;

  private:
    SurfaceTouch touch_;
};

// Where the cutter is at a time of the program. Real-time safe; any thread.
class CutterTrack {
  public:
    // Of a setup before it is run.
    explicit CutterTrack(const MillSetup& setup);
    haptics::Cylinder at(double t_s) const noexcept;

  private:
    std::vector<motion::Move> moves_;
    std::shared_ptr<const motion::Schedule> schedule_;
    std::vector<std::size_t> cutter_of_move_;
    std::vector<haptics::Cylinder> cutters_;  // radius and length
};

// F_fem + F_tex about the cutter on its track (the paper's section 3.2). One thread; render() is real-time
// safe.
class NearCutter {
  public:
    // `force` must outlive this. `finger_mm`: radius of the finger's cylinder.
    NearCutter(haptics::CuttingForce& force, double finger_mm, double tick_s);

    void switch_cutting(bool on) { field_.switch_cutting(on); }
    // At this moment of the program. `textures`: null for none.
    haptics::FieldForce render(const haptics::HandReading& hand, double at_s, const CutterTrack& track,
                               const haptics::TextureMap* textures) noexcept;

  private:
    double finger_mm_;
    haptics::ForceField field_;
};

// Eight textured triangles for places along the cut, at least `spacing_mm` of path apart.
haptics::TextureMap texture_map(std::span<const milling::CutRow> cut, const contact::DistanceField& machined,
                                const ParallelFor& parallel, double spacing_mm = 2);

struct CutSourceOptions {
    double start_s = 0;    // of the program, where the servo's clock is 0
    double finger_mm = 0;  // radius of the finger's cylinder
    double tick_s = 1e-3;
    bool texture = true;
    // The part while it is milled, which must outlive the source; null: it is not felt.
    field::FieldReader* part = nullptr;
    haptics::ContactOptions contact{};  // with the part
    haptics::ProbeShape probe{};
};

// Cut mode: the force near the cutter while the program runs, and contact where the probe touches the part as
// it stands at that moment.
class CutSource final : public haptics::ForceSource {
  public:
    // Everything must outlive this; no force where the table holds none.
    CutSource(const CutterTrack& track, haptics::CuttingForce& force, const haptics::TextureMap& textures,
              const CutSourceOptions& options);

    haptics::RenderedForce render(const haptics::HandReading& hand, double now_s,
                                  double tick_s) noexcept override;

  private:
    const CutterTrack& track_;
    const haptics::TextureMap& textures_;
    CutSourceOptions options_;
    NearCutter near_cutter_;
    std::optional<SurfaceTouch> touch_;
};

// Limits for a device: its own numbers. Where no motors move a hand there is no ramp, and the slew limit is
// what leaves a tooth's force as it is.
haptics::SafetyLimits safety_limits(const haptics::Device& device, double rate_hz);

}  // namespace tribo::session
