// SPDX-License-Identifier: MIT
// What a hand feels of a milled part: the sources of force that a servo asks, made from a finished run.
#pragma once

#include <memory>

#include "contact/distance_field.hpp"
#include "haptics/field_contact.hpp"
#include "haptics/safety.hpp"
#include "haptics/servo.hpp"

namespace tribo::session {

enum class FeelMode {
    cut,      // the cutting force while the program runs, felt near the cutter
    inspect,  // the part as the program leaves it
};

// Inspect mode: F_reaction = k N_sur from a god-object on the surface (the paper's section 3.2).
class InspectSource final : public haptics::ForceSource {
  public:
    // `surface` must outlive this and stay as it is.
    InspectSource(const contact::DistanceField& surface, const haptics::ContactOptions& options)
        : contact_(surface, options) {}

    haptics::RenderedForce render(const haptics::HandReading& hand, double now_s,
                                  double tick_s) noexcept override;

  private:
    haptics::FieldContact contact_;
};

// Limits for a device: its own numbers, and the ramp only where motors move a hand.
haptics::SafetyLimits safety_limits(const haptics::Device& device, double rate_hz);

}  // namespace tribo::session
