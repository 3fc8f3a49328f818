// SPDX-License-Identifier: MIT
// A finger on a sheet: an elliptical contact patch with a force. Plain data. Lengths are millimetres of the
// image. Its origin is the top left corner, x points right, y points down.
#pragma once

#include <cmath>

namespace tribo::elastic {

struct ContactEllipse {
    double x_mm = 0, y_mm = 0;  // centre
    // Half axes of the patch, > 0, and the angle from x to the first one.
    double half_width_mm = 6, half_height_mm = 6;
    double angle_rad = 0;
    double force_n = 0;  // into the image; without a positive force there is no contact
    double held_s = 0;   // time since the contact began, >= 0; the published model uses only this time

    bool operator==(const ContactEllipse&) const = default;
};

// Limits that keep every sum finite. A contact outside of them is ignored.
inline constexpr double kMostForceN = 1e3;
inline constexpr double kMostLengthMm = 1e6;  // of coordinates and half axes
inline constexpr double kLeastRadiusMm = 1e-3;

inline bool touches(const ContactEllipse& c) {
    const bool placed = std::abs(c.x_mm) <= kMostLengthMm && std::abs(c.y_mm) <= kMostLengthMm;
    const bool sized = c.half_width_mm >= kLeastRadiusMm && c.half_width_mm <= kMostLengthMm &&
                       c.half_height_mm >= kLeastRadiusMm && c.half_height_mm <= kMostLengthMm;
    return placed && sized && std::isfinite(c.angle_rad) && c.force_n > 0 && c.force_n <= kMostForceN &&
           c.held_s >= 0 && std::isfinite(c.held_s);
}

}  // namespace tribo::elastic
