// SPDX-License-Identifier: MIT
#include "dynamics/tool_estimate.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "dynamics/tool_beam.hpp"

namespace tribo::dynamics {
namespace {

constexpr double kDamping = 0.02;
constexpr std::size_t kAsked = 6;    // modes of which the most flexible ones are kept
constexpr double kSmallShare = 0.3;  // of the flexibility of the first: the second is left out
// Round numbers of the size that published models have: of the tool in its holder, and of the holder in the
// spindle (docs/chatter.md).
constexpr BeamJoint kInHolder{20e3, 1.5e9}, kInSpindle{50e3, 1.5e9};

BeamJoint in_series(const BeamJoint& a, const BeamJoint& b) {
    const auto both = [](double p, double q) { return p * q / (p + q); };
    return {both(a.across_n_per_mm, b.across_n_per_mm), both(a.turn_nmm_per_rad, b.turn_nmm_per_rad)};
}

std::vector<BeamPart> parts_of(const milling::Cutter& cutter) {
    ToolBeam beam = tool_beam(cutter);
    if (beam.holder.empty()) return {{std::move(beam.body), in_series(kInHolder, kInSpindle)}};
    return {{std::move(beam.body), kInHolder}, {std::move(beam.holder), kInSpindle}};
}

}  // namespace

std::vector<Mode> estimated_modes(const milling::Cutter& cutter) {
    assert(cutter.stickout_mm > 0);
    std::vector<BendingMode> bending = bending_modes(parts_of(cutter), kAsked);
    // No two modes are alike in both.
    const auto flexible_first = [](const BendingMode& a, const BendingMode& b) {
        return std::pair(a.stiffness_n_per_mm, a.frequency_hz) <
               std::pair(b.stiffness_n_per_mm, b.frequency_hz);
    };
    std::sort(bending.begin(), bending.end(), flexible_first);
    const bool one = bending[0].stiffness_n_per_mm < kSmallShare * bending[1].stiffness_n_per_mm;
    bending.resize(one ? 1 : 2);
    if (!one && bending[0].frequency_hz > bending[1].frequency_hz) std::swap(bending[0], bending[1]);
    std::vector<Mode> modes;
    for (const BendingMode& mode : bending)
        for (const Vec3 direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}})
            modes.push_back({direction, mode.frequency_hz, kDamping, mode.stiffness_n_per_mm, ModeOn::tool,
                             kEstimateSpread, true});
    return modes;
}

}  // namespace tribo::dynamics
