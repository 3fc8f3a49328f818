// SPDX-License-Identifier: MIT
// Form error and waves of a machined surface under the probe, as a force beside the contact with the surface
// of a tool that does not bend.
#pragma once

#include "haptics/contact/field_contact.hpp"
#include "surface/form_error.hpp"

namespace tribo::session {

// A surface that stands out by w pushes with k (penetration + w), never inward. The contact already pushes
// with k times the penetration; this adds the rest, continuously from the first touch on. Waves that the
// servo cannot carry at the speed of the hand fade (haptics::groove_gain); their mean stays. One thread;
// force() is real-time safe.
class SurfaceWaves {
  public:
    // `error` must outlive this object.
    SurfaceWaves(const surface::FormError& error, double stiffness_n_per_mm)
        : error_(error), stiffness_n_per_mm_(stiffness_n_per_mm) {}

    Vec3 force(const haptics::ProbeContact& contact, double tick_s) noexcept;

  private:
    const surface::FormError& error_;
    double stiffness_n_per_mm_;
    double mean_mm_ = 0;  // what stands on the way of the last tenth of a second
    bool touching_ = false;
};

}  // namespace tribo::session
