// SPDX-License-Identifier: MIT
// The force on the teeth of a tool that vibrates.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "dynamics/vibration.hpp"

namespace tribo::dynamics {
namespace {

double sum(D2 lanes) {
    return lanes[0] + lanes[1];
}

double chip_at(const milling::TurnLaw& law, D2 normal) {
    return law.sine * normal[0] + law.cosine * normal[1] + law.constant;
}

// Sine and cosine of a rotation that lags by so much.
D2 behind(D2 normal, double sine, double cosine) {
    return both(cosine) * normal + D2{-sine, sine} * D2{normal[1], normal[0]};
}

}  // namespace

void Vibration::gather_straight_teeth() {
    const milling::CuttingCoefficients& k = coefficients_;
    straight_teeth_.clear();
    double height = 0;
    const std::span<const EdgeInCut> list = in_cut_.list();
    for (std::size_t n = 0; n < list.size(); ++n) {
        const std::size_t tooth = list[n].tooth;
        height += slices_[list[n].slice].whole.height_mm;
        if (n + 1 < list.size() && list[n + 1].tooth == tooth) continue;
        const std::size_t other = tooth + 1 == phase_rad_.size() ? 0 : tooth + 1;
        straight_teeth_.push_back({tooth, runout_mm_[tooth][1] - runout_mm_[other][1], height * k.ktc,
                                   height * k.kte, height * k.krc, height * k.kre, height * k.kac,
                                   height * k.kae});
        height = 0;
    }
}

// The bands of a straight edge, all at one angle.
LaneVec3 Vibration::straight_force() {
    if (in_cut_.update(past_.samples(), spindle_.turn_rad())) gather_straight_teeth();
    LaneVec3 force_n;
    for (const StraightTooth& t : straight_teeth_) {
        const D2 normal = tip(t.tooth);
        const ToolPast::Passage& last = past_.passage(t.tooth, 0);
        double thickness = sum(last.beyond.tip_mm.xy * normal) + t.outward_mm;
        if (!past_.cut_whole(last, t.tooth) || !(thickness > 0)) [[unlikely]] {
            const Outward there{normal, {}, {.radius_mm = cutter_.radius_mm()}};
            thickness = chip_at(chip<false>({t.tooth, normal, past_.passages(t.tooth)}, there), normal);
            if (!(thickness > 0)) continue;
        }
        const double tangential = t.tangential * thickness + t.tangential_n;
        const double radial = t.radial * thickness + t.radial_n;
        force_n.xy += both(tangential) * D2{-normal[1], normal[0]} - both(radial) * normal;
        force_n.z -= t.axial * thickness + t.axial_n;
    }
    return force_n;
}

LaneVec3 Vibration::helical_force() {
    in_cut_.update(past_.samples(), spindle_.turn_rad());
    Vec3 force_n{};
    Edge edge;
    for (const EdgeInCut& in_cut : in_cut_.list()) {
        if (edge.before.empty() || edge.tooth != in_cut.tooth)
            edge = {in_cut.tooth, tip(in_cut.tooth), past_.passages(in_cut.tooth)};
        const EdgeSlice& slice = slices_[in_cut.slice];
        if (in_cut.whole) {
            force_n += slice.round ? nodes_force(edge, slice.nodes) : piece_force(edge, slice.whole);
            continue;
        }
        const double tip_rad = spindle_.rotation_rad() + phase_rad_[edge.tooth];
        for_each_zone(slice.band, tip_rad, slicer_.lag_per_mm(), [&](EngagedZone zone) {
            force_n += slice.round ? nodes_force(edge, slicer_.nodes(slice, zone))
                                   : piece_force(edge, slicer_.piece(slice, zone));
        });
    }
    return {D2{force_n.x, force_n.y}, force_n.z};
}

template <bool kRound>
milling::TurnLaw Vibration::chip(const Edge& edge, const Outward& there) {
    const bool turns = past_.turns(), runout = cutter_.runout_mm != 0;
    const milling::ProfilePoint& at = there.at;
    const double arm = kRound ? at.height_mm * at.sin_kappa + at.radius_mm * at.cos_kappa : at.height_mm;
    const auto law_of = [&](const ToolPast::Passage& p) {
        D2 xy = p.beyond.tip_mm.xy;
        if constexpr (kRound) xy *= both(at.sin_kappa);
        if (turns) xy += both(arm) * p.beyond.turn_rad;
        milling::TurnLaw law{xy[0], xy[1], 0};
        if (runout) {
            const D2 outward = runout_mm_[edge.tooth] - runout_mm_[past_.tooth_of(p, edge.tooth)];
            law.constant = at.sin_kappa * sum(outward * D2{there.lag.sine, there.lag.cosine});
        }
        if constexpr (kRound) law.constant -= p.beyond.tip_mm.z * at.cos_kappa;
        return law;
    };
    milling::TurnLaw thinnest = law_of(edge.before[0]);
    double least = chip_at(thinnest, there.normal);
    for (const ToolPast::Passage& p : edge.before.subspan(1)) {
        const milling::TurnLaw law = law_of(p);
        const double thickness = chip_at(law, there.normal);
        if (thickness >= least) continue;
        thinnest = law;
        least = thickness;
    }
    if (!(least > 0)) stands_clear(edge.tooth);
    return thinnest;
}

Vec3 Vibration::piece_force(const Edge& edge, const EdgePiece& piece) {
    const D2 normal = behind(edge.tip, piece.lag.sine, piece.lag.cosine);
    const milling::TurnLaw law = chip<false>(edge, {normal, piece.lag, piece.middle});
    // At both ends.
    const milling::HalfSpan& half = piece.half;
    const double low = chip_at(law, behind(normal, half.sine, half.cosine)),
                 high = chip_at(law, behind(normal, -half.sine, half.cosine));
    const milling::EdgeLoad load = milling::edge_load(coefficients_, law, piece.middle);
    if (low > 0 && high > 0)
        return milling::segment_force(load, normal[0], normal[1], half, piece.height_mm).force_n;
    stands_clear(edge.tooth);
    if (low <= 0 && high <= 0) return {};
    // The chip ends within the piece: almost on a straight line, for it is short. `share`: of the piece that
    // cuts.
    const double share = std::max(low, high) / std::abs(high - low);
    const double half_rad = math::atan2(half.sine, half.cosine);
    const milling::HalfSpan shift = milling::half_span((low > 0 ? 1 : -1) * (1 - share) * half_rad);
    const D2 middle = behind(normal, shift.sine, shift.cosine);
    return milling::segment_force(load, middle[0], middle[1], milling::half_span(share * half_rad),
                                  share * piece.height_mm)
        .force_n;
}

Vec3 Vibration::nodes_force(const Edge& edge, const EdgeNodes& nodes) {
    Vec3 force_n{};
    for (const EdgeNode& node : nodes) {
        const D2 normal = behind(edge.tip, node.lag.sine, node.lag.cosine);
        const milling::TurnLaw law = chip<true>(edge, {normal, node.lag, node.at});
        if (chip_at(law, normal) <= 0) continue;
        const milling::EdgeLoad load = milling::edge_load(coefficients_, law, node.at);
        force_n += node.length_mm * milling::force_at_rotation(load, normal[0], normal[1]).force_n;
    }
    return force_n;
}

}  // namespace tribo::dynamics
