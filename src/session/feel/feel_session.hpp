// SPDX-License-Identifier: MIT
// What a hand feels of a milled part and of its cut: the sources of force that a servo asks, made from a run.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "contact/distance_field.hpp"
#include "contact/force_table.hpp"
#include "haptics/contact/force_field.hpp"
#include "haptics/contact/probe_shape.hpp"
#include "haptics/servo/force_scaling.hpp"
#include "haptics/servo/safety.hpp"
#include "haptics/servo/servo.hpp"
#include "session/cut/cut_record.hpp"

namespace tribo::session {

// Inspect mode: F_reaction = k N_sur from a god-object on the surface (the paper's section 3.2).
class InspectSource final : public haptics::ForceSource {
  public:
    // `surface` must outlive this and stay as it is.
    InspectSource(const contact::DistanceField& surface, const haptics::ContactOptions& options,
                  haptics::ProbeShape probe = {})
        : contact_(surface, options), probe_(std::move(probe)) {}

    haptics::RenderedForce render(const haptics::HandReading& hand, double now_s,
                                  double tick_s) noexcept override;

  private:
    haptics::FieldContact contact_;
    haptics::ProbeShape probe_;
    std::array<Vec3, haptics::ProbeGap::kMostBalls> balls_{};
};

// Where the cutter is at a time of the program. Real-time safe; any thread.
class CutterTrack {
  public:
    // Of a setup before it is run.
    explicit CutterTrack(const MillSetup& setup);
    haptics::Cylinder at(double t_s) const noexcept;

  private:
    std::vector<motion::Move> moves_;
    motion::Schedule schedule_;
    std::vector<std::size_t> cutter_of_move_;
    std::vector<haptics::Cylinder> cutters_;  // radius and length
};

// The cutting force from a table, scaled for the hand.
class TableForce final : public haptics::CuttingForce {
  public:
    TableForce(contact::ForceTable table, const haptics::ForceScaling& scaling, double rate_hz)
        : table_(std::move(table)), scaling_(scaling), rate_hz_(rate_hz) {}
    Vec3 force_n(double at_s) noexcept override;

  private:
    contact::ForceTable table_;
    haptics::ForceScaling scaling_;
    double rate_hz_;
    contact::ForceTable::Cursor cursor_;
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

// Cut mode: F_fem + F_tex near the cutter while the program runs (the paper's section 3.2), and contact where
// the probe touches the part as it stands at that moment.
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
    haptics::ForceField field_;
    std::optional<InspectSource> touch_;
};

// Limits for a device: its own numbers. Where no motors move a hand there is no ramp, and the slew limit is
// what leaves a tooth's force as it is.
haptics::SafetyLimits safety_limits(const haptics::Device& device, double rate_hz);

}  // namespace tribo::session
