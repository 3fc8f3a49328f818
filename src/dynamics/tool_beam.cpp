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
    bending.yield_mm = yield_mm_per_n(beam, height_mm, 0);
    double high = 0;
    for (const BeamSection& section : beam.body) {
        high += section.length_mm;
        const double d = section.diameter_mm, stress = 32 * (high - height_mm) / (math::kPi * d * d * d);
        if (stress > bending.stress_per_mm2) {
            bending.stress_per_mm2 = stress;
            bending.stress_height_mm = high;
        }
    }
    return bending;
}

double yield_mm_per_n(const ToolBeam& beam, double force_mm, double at_mm) {
    double yield = 0, low = 0;
    // Of a unit force the moment at the height z is z - force, and that of a unit force at the place z - at:
    // the integral of their product over the stiffness is the displacement (Castigliano 1873).
    const auto add = [&](const BeamSection& section) {
        const double d = section.diameter_mm, high = low + section.length_mm;
        const double from = std::max({low, force_mm, at_mm});
        low = high;
        if (!(high > from)) return;
        const double stiffness = section.material.young_n_per_mm2 * math::kPi / 64 * d * d * d * d;
        yield += ((high * high * high - from * from * from) / 3 -
                  (force_mm + at_mm) * (high * high - from * from) / 2 + force_mm * at_mm * (high - from)) /
                 stiffness;
    };
    for (const BeamSection& section : beam.body) add(section);
    for (const BeamSection& section : beam.holder) add(section);
    return yield;
}

}  // namespace tribo::dynamics
