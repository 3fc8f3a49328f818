// SPDX-License-Identifier: MIT
#include "milling/tool/cutter.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/math.hpp"

namespace tribo::milling {
namespace {

constexpr int kMaxFlutes = 64;
constexpr double kMaxHelixDeg = 85;      // beyond it a flute is a thread, and the lag per mm has no meaning
constexpr double kPitchSlackDeg = 0.05;  // pitch angles as printed in drawings must still close

bool positive(double x) {
    return std::isfinite(x) && x > 0;
}

std::unexpected<Error> refuse(const char* key, const std::string& cause, const std::string& remedy) {
    return fail("cutter " + std::string(key) + " " + cause, remedy);
}

Result<void> check_pitch(const Cutter& c) {
    if (c.pitch_deg.empty()) return {};
    if (c.pitch_deg.size() != static_cast<std::size_t>(c.flutes)) {
        return refuse("pitch_deg",
                      "has " + std::to_string(c.pitch_deg.size()) + " angles for " +
                          std::to_string(c.flutes) + " flutes",
                      "give one angle from each flute to the next, or leave the key out for uniform pitch");
    }
    double sum = 0;
    for (const double p : c.pitch_deg) {
        if (!positive(p)) {
            return refuse("pitch_deg", "holds an angle that is not above 0", "give angles in degrees");
        }
        sum += p;
    }
    if (std::abs(sum - 360) > kPitchSlackDeg) {
        return refuse("pitch_deg", "does not add up to 360 degrees", "make the angles close the turn");
    }
    return {};
}

}  // namespace

double Cutter::radius_at(double z_mm) const {
    const double corner = corner_radius_mm(), radius = radius_mm();
    if (z_mm >= corner) return radius;
    const double below = corner - std::max(z_mm, 0.0);
    return radius - corner + std::sqrt(corner * corner - below * below);
}

double Cutter::lag_rad(double z_mm) const {
    return z_mm * math::tan(helix_deg * math::kRadPerDeg) / radius_mm();
}

Result<void> check(const Cutter& c) {
    if (!positive(c.diameter_mm)) {
        return refuse("diameter_mm", "is not a length above 0", "give the diameter in millimetres");
    }
    if (c.kind == CutterKind::bull && !(positive(c.corner_mm) && c.corner_mm < c.radius_mm())) {
        return refuse("corner_mm", "is not between 0 and the radius",
                      "give the corner radius of the bull-nose cutter, or make it flat or ball");
    }
    if (c.flutes < 1 || c.flutes > kMaxFlutes) {
        return refuse("flutes", "is not between 1 and " + std::to_string(kMaxFlutes), "count the teeth");
    }
    if (!(std::abs(c.helix_deg) <= kMaxHelixDeg)) {
        return refuse("helix_deg", "is not between -85 and 85 degrees",
                      "use 0 for straight flutes, a negative angle for a left-hand helix");
    }
    if (!(c.core_mm >= 0 && c.core_mm <= c.diameter_mm - 2 * c.corner_radius_mm())) {
        return refuse("core_mm", "is not between 0 and the diameter of the flat bottom",
                      "give the diameter that the bottom edges leave out, or 0 where they cut over centre");
    }
    if (!positive(c.length_mm)) {
        return refuse("length_mm", "is not a length above 0", "give the length of the cutting edges");
    }
    if (c.length_mm < c.corner_radius_mm()) {
        return refuse("length_mm", "is shorter than the rounded bottom",
                      "make it at least the corner radius");
    }
    if (!(c.runout_mm >= 0 && c.runout_mm < c.radius_mm())) {
        return refuse("runout_mm", "is not between 0 and the radius",
                      "give the offset of the tool axis, usually 0.005 to 0.05 mm");
    }
    if (!std::isfinite(c.runout_deg))
        return refuse("runout_deg", "is not a number", "give an angle in degrees");
    for (const HolderStep& step : c.holder) {
        if (!positive(step.diameter_mm) || !positive(step.length_mm)) {
            return refuse("holder", "has a step without diameter or length",
                          "give each step from the bottom up as [diameter_mm, length_mm]");
        }
    }
    return check_pitch(c);
}

}  // namespace tribo::milling
