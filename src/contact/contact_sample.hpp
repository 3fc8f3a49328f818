// SPDX-License-Identifier: MIT
// A contact at one moment, for a sense such as sound. Producers (a cutter in stock, a finger on a surface or
// on a screen) write ContactSamples, and sound reads them. Neither side depends on the other.
// session/cut/contact_of_cut.hpp makes the samples of a cut.
//
//   field        a cutter                               a finger or probe
//   position     tool tip                               point of contact
//   normal       tool axis, tip to shank                out of the material
//   force        on the tool, mean over a turn          on the finger
//   slip         feed velocity of the tip               velocity along the surface
//   area         cut across the feed; 0 where the tip   of the patch that touches
//                stands and only the axis turns
//   removed      material per second                    0
//   phase        spindle angle, from the datum of       0
//                ForceSpectrum
//   spectrum     force over the turn                    none
//   edges        that pass in a turn of the spindle     0
//   vibration    what it adds to the force              none
//
// Plain data: copied freely, no allocation. Vectors are in the frame of the stock (the touched body). A
// sample is a moment, not an interval. Between two samples all values are linear; the phase follows its rate.
#pragma once

#include <cmath>

#include "base/vec3.hpp"
#include "contact/force_spectrum.hpp"
#include "contact/force_trace.hpp"

namespace tribo::contact {

struct ContactSample {
    double t_s = 0;  // since the session start; times never fall, equal times make a step
    Vec3 position_mm;
    Vec3 normal{0, 0, 1};          // unit
    Vec3 force_n;                  // on the touching object; zero: no contact
    Vec3 slip_mm_per_s;            // of the touching object, relative to the material
    double area_mm2 = 0;           // >= 0
    double removed_mm3_per_s = 0;  // >= 0

    double phase_rad = 0;             // at t_s; whole turns may be left out
    double phase_rate_rad_per_s = 0;  // >= 0 for a spindle that turns the right way

    // The periodic part of the force, in the frame of the tool; null or empty: none. It must live only as
    // long as the call that takes the sample.
    const ForceSpectrum* spectrum = nullptr;
    int edges = 0;  // of the cutter; 0: unknown

    // What a vibration adds to the force of the spectrum; null: nothing. Each trace begins where the one of
    // the sample before ended, or later, and may reach beyond t_s. It must live as long as the spectrum.
    const ForceTrace* vibration = nullptr;
};

// Returns true if all values are finite; senses refuse other samples. Real-time safe.
inline bool is_finite(const ContactSample& s) {
    if (!(std::isfinite(s.t_s) && tribo::is_finite(s.position_mm) && tribo::is_finite(s.normal) &&
          tribo::is_finite(s.force_n) && tribo::is_finite(s.slip_mm_per_s) && std::isfinite(s.area_mm2) &&
          std::isfinite(s.removed_mm3_per_s) && std::isfinite(s.phase_rad) &&
          std::isfinite(s.phase_rate_rad_per_s))) {
        return false;
    }
    if (s.vibration != nullptr) {
        for (const auto& [x, y] : s.vibration->force_n) {
            if (!std::isfinite(x) || !std::isfinite(y)) return false;
        }
    }
    if (s.spectrum == nullptr) return true;
    for (const ForceHarmonic& h : s.spectrum->harmonics) {
        for (const std::complex<double>& channel : {h.x, h.y, h.z, h.torque}) {
            if (!std::isfinite(channel.real()) || !std::isfinite(channel.imag())) return false;
        }
    }
    return true;
}

}  // namespace tribo::contact
