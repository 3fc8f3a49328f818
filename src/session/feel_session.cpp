// SPDX-License-Identifier: MIT
#include "session/feel_session.hpp"

namespace tribo::session {

haptics::RenderedForce InspectSource::render(const haptics::HandReading& hand, double now_s,
                                             double /*tick_s*/) noexcept {
    const haptics::Contact contact = contact_.update(hand.position_mm);
    haptics::RenderedForce felt;
    felt.contact_n = contact.force_n;
    felt.touching = contact.in_contact;
    felt.simulation_s = now_s;  // the part does not change any more
    return felt;
}

haptics::SafetyLimits safety_limits(const haptics::Device& device, double rate_hz) {
    haptics::SafetyLimits limits;
    limits.max_force_n = device.limits().max_force_n;
    limits.damping_n_s_per_mm = 0.5 * device.limits().max_damping_n_s_per_mm;
    limits.tick_s = 1 / rate_hz;
    if (!device.has_motors()) limits.ramp_s = 0;
    return limits;
}

}  // namespace tribo::session
