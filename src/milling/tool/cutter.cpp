// SPDX-License-Identifier: MIT
#include "milling/tool/cutter.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "base/math.hpp"
#include "base/text/limit_text.hpp"
#include "milling/tool/cutter_shape.hpp"

namespace tribo::milling {
namespace {

constexpr double kPitchSlackDeg = 0.05;  // pitch angles as printed in drawings must still close

std::unexpected<Error> refuse(const char* key, const std::string& cause, const std::string& remedy) {
    return fail("cutter " + std::string(key) + " " + cause, remedy);
}

Result<void> check_numbers(const Cutter& c) {
    struct Number {
        const char* key;
        double value;
        const Limit& limit;
    };
    const double corner = c.kind >= CutterKind::bull ? c.corner_mm : 0;
    for (const auto& [key, value, limit] : {Number{"diameter_mm", c.diameter_mm, kLimits.cutter_diameter},
                                            Number{"corner_mm", corner, kLimits.corner_radius},
                                            Number{"flutes", static_cast<double>(c.flutes), kLimits.flutes},
                                            Number{"helix_deg", c.helix_deg, kLimits.helix},
                                            Number{"core_mm", c.core_mm, kLimits.core_diameter},
                                            Number{"length_mm", c.length_mm, kLimits.cutting_length},
                                            Number{"runout_mm", c.runout_mm, kLimits.runout},
                                            Number{"runout_deg", c.runout_deg, kLimits.runout_angle}}) {
        if (limit.range.contains(value)) continue;
        return refuse(key, "is " + plain_number(value), range_remedy(limit));
    }
    for (const HolderStep& step : c.holder) {
        for (const double size : {step.diameter_mm, step.length_mm}) {
            if (kLimits.holder.range.contains(size)) continue;
            return refuse("holder", "has a step of " + plain_number(size) + " mm",
                          range_remedy(kLimits.holder));
        }
    }
    return {};
}

// Neck, shank and stick-out, which are 0 where they are not given.
Result<void> check_shank(const Cutter& c) {
    struct Number {
        const char* key;
        double value;
        const Limit& limit;
    };
    for (const auto& [key, value, limit] : {Number{"stickout_mm", c.stickout_mm, kLimits.stickout},
                                            Number{"shank_mm", c.shank_mm, kLimits.shank_diameter},
                                            Number{"neck_mm", c.neck_mm, kLimits.shank_diameter},
                                            Number{"reach_mm", c.reach_mm, kLimits.stickout}}) {
        if (value == 0) continue;
        if (!limit.range.contains(value))
            return refuse(key, "is " + plain_number(value), range_remedy(limit));
        const bool is_shape = key == std::string_view("neck_mm") && is_shape_key(c.kind, key);
        if (c.stickout_mm == 0 && !is_shape)
            return refuse(key, "says nothing without a stick-out",
                          "add stickout_mm, from the tip to the holder's face");
    }
    if (c.stickout_mm == 0) return {};
    if (c.stickout_mm < c.length_mm)
        return refuse("stickout_mm",
                      "is shorter than the cutting edges of " + plain_number(c.length_mm) + " mm",
                      "give the length from the tip to the holder's face, or correct length_mm");
    const double shank = c.shank_mm > 0 ? c.shank_mm : c.top_diameter_mm();
    if (c.neck_mm > shank)
        return refuse("neck_mm", "is wider than the shank of " + plain_number(shank) + " mm",
                      "give the diameter of the relieved neck, or the shank's as shank_mm");
    if (c.reach_mm == 0) return {};
    if (c.neck_mm == 0)
        return refuse("reach_mm", "is the end of a neck, and there is none", "add neck_mm, its diameter");
    if (c.reach_mm < c.length_mm || c.reach_mm > c.stickout_mm)
        return refuse("reach_mm", "is not between the end of the edges and the holder",
                      "give the height above the tip at which the neck ends: " + plain_number(c.length_mm) +
                          " to " + plain_number(c.stickout_mm));
    return {};
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
        if (!kLimits.pitch.range.contains(p)) {
            return refuse("pitch_deg", "holds " + plain_number(p), range_remedy(kLimits.pitch));
        }
        sum += p;
    }
    if (std::abs(sum - 360) > kPitchSlackDeg) {
        return refuse("pitch_deg", "does not add up to 360 degrees", "make the angles close the turn");
    }
    return {};
}

}  // namespace

double Cutter::lag_rad(double z_mm) const {
    return z_mm * math::tan(helix_deg * math::kRadPerDeg) / radius_mm();
}

std::vector<HolderStep> Cutter::shank_steps() const {
    std::vector<HolderStep> steps;
    double height = length_mm;
    const auto up_to = [&](double end_mm, double wide_mm) {
        if (end_mm > height) steps.push_back({wide_mm, end_mm - height});
        height = std::max(height, end_mm);
    };
    if (neck_mm > 0) up_to(reach_mm > 0 ? reach_mm : stickout_mm, neck_mm);
    up_to(stickout_mm, shank_mm > 0 ? shank_mm : top_diameter_mm());
    return steps;
}

std::vector<HolderStep> Cutter::steps() const {
    std::vector<HolderStep> all = shank_steps();
    all.insert(all.end(), holder.begin(), holder.end());
    return all;
}

Result<void> check(const Cutter& c) {
    if (auto done = check_numbers(c); !done) return done;
    if (c.kind == CutterKind::bull && !(c.corner_mm > 0 && c.corner_mm < c.radius_mm())) {
        return refuse("corner_mm", "is not between 0 and the radius",
                      "give the corner radius of the bull-nose cutter, or make it flat or ball");
    }
    if (c.has_profile()) {
        if (auto done = check_profile(c); !done) return done;
    }
    if (!(c.core_mm <= c.diameter_mm - 2 * c.corner_radius_mm())) {
        return refuse("core_mm", "is not between 0 and the diameter of the flat bottom",
                      "give the diameter that the bottom edges leave out, or 0 where they cut over centre");
    }
    if (!c.has_profile() && c.length_mm < c.corner_radius_mm()) {
        return refuse("length_mm", "is shorter than the rounded bottom",
                      "make it at least the corner radius");
    }
    if (!(c.runout_mm < c.radius_mm())) {
        return refuse("runout_mm", "is not between 0 and the radius",
                      "give the offset of the tool axis, usually 0.005 to 0.05 mm");
    }
    if (auto done = check_shank(c); !done) return done;
    return check_pitch(c);
}

}  // namespace tribo::milling
