// SPDX-License-Identifier: MIT
// What touches a sheet: an ellipse with a force. Plain data; lengths in millimetres of the image, whose
// origin is its top left corner, x to the right, y down.
#pragma once

#include <cmath>

namespace tribo::elastic {

struct Contact {
    double x_mm = 0, y_mm = 0;  // centre
    // Half axes of the patch that touches, > 0, and the angle from x to the first one.
    double half_width_mm = 6, half_height_mm = 6;
    double angle_rad = 0;
    double force_n = 0;  // into the image; what is not above 0 does not touch
    double held_s = 0;   // since the contact began, >= 0; the published model presses by time alone

    bool operator==(const Contact&) const = default;
};

// Limits that keep every sum finite; a contact outside of them does not touch.
inline constexpr double kMostForceN = 1e3;
inline constexpr double kMostLengthMm = 1e6;  // of coordinates and half axes
inline constexpr double kLeastRadiusMm = 1e-3;

inline bool touches(const Contact& c) {
    const bool placed = std::abs(c.x_mm) <= kMostLengthMm && std::abs(c.y_mm) <= kMostLengthMm;
    const bool sized = c.half_width_mm >= kLeastRadiusMm && c.half_width_mm <= kMostLengthMm &&
                       c.half_height_mm >= kLeastRadiusMm && c.half_height_mm <= kMostLengthMm;
    return placed && sized && std::isfinite(c.angle_rad) && c.force_n > 0 && c.force_n <= kMostForceN &&
           c.held_s >= 0 && std::isfinite(c.held_s);
}

}  // namespace tribo::elastic
