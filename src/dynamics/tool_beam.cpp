// SPDX-License-Identifier: MIT
#include "dynamics/tool_beam.hpp"

#include <algorithm>

#include "base/math.hpp"
#include "milling/tool/cutter_profile.hpp"

namespace tribo::dynamics {
namespace {

constexpr BeamMaterial kCarbide{600e3, 0.22, 14.5e-9}, kHighSpeedSteel{210e3, 0.3, 8.1e-9};
constexpr BeamMaterial kSteel{210e3, 0.3, 7.85e-9};

// A profile in thin slices.
void add_edges(const milling::Cutter& cutter, const BeamMaterial& body, std::vector<BeamSection>& sections) {
    constexpr int kSlices = 16;  // of each line or arc
    const milling::CutterProfile profile(cutter);
    for (const milling::CutterProfile::Part& part : profile.parts()) {
        const double low = part.element.from.z, step = (part.element.to.z - low) / kSlices;
        if (part.is_level()) continue;
        for (int n = 0; n < kSlices; ++n) {
            const double radius = part.at(part.at_height(low + (n + 0.5) * step)).radius_mm;
            sections.push_back({kFlutedShare * 2 * radius, step, body});
        }
    }
}

}  // namespace

ToolBeam tool_beam(const milling::Cutter& cutter) {
    const BeamMaterial& body = cutter.body == milling::CutterBody::carbide ? kCarbide : kHighSpeedSteel;
    ToolBeam beam;
    if (cutter.has_profile()) {
        add_edges(cutter, body, beam.body);
    } else {
        beam.body.push_back({kFlutedShare * cutter.diameter_mm, cutter.length_mm, body});
    }
    for (const milling::HolderStep& step : cutter.shank_steps())
        beam.body.push_back({step.diameter_mm, step.length_mm, body});
    for (const milling::HolderStep& step : cutter.holder)
        beam.holder.push_back({step.diameter_mm, step.length_mm, kSteel});
    return beam;
}

BendingByForce bending_by_force(const ToolBeam& beam, double height_mm) {
    BendingByForce bending;
    double low = 0;
    // The moment at the height z is (z - height) per newton; a unit force at the tip has the moment z there.
    const auto add = [&](const BeamSection& section, bool is_body) {
        const double d = section.diameter_mm, high = low + section.length_mm, from = std::max(low, height_mm);
        low = high;
        if (!(high > from)) return;
        const double stiffness = section.material.young_n_per_mm2 * math::kPi / 64 * d * d * d * d;
        bending.yield_mm +=
            ((high * high * high - from * from * from) / 3 - height_mm * (high * high - from * from) / 2) /
            stiffness;
        const double stress = 32 * (high - height_mm) / (math::kPi * d * d * d);
        if (is_body && stress > bending.stress_per_mm2) {
            bending.stress_per_mm2 = stress;
            bending.stress_height_mm = high;
        }
    };
    for (const BeamSection& section : beam.body) add(section, true);
    for (const BeamSection& section : beam.holder) add(section, false);
    return bending;
}

}  // namespace tribo::dynamics
