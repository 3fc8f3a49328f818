// SPDX-License-Identifier: MIT
// The force on the teeth of a tool that vibrates.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.hpp"
#include "dynamics/vibration.hpp"

namespace tribo::dynamics {
namespace {

double sum(D2 lanes) {
    return lanes[0] + lanes[1];
}

double at_rotation(const milling::TurnLaw& law, D2 normal) {
    return law.sine * normal[0] + law.cosine * normal[1] + law.constant;
}

// Sine and cosine of a rotation that lags by so much.
D2 behind(D2 normal, double sine, double cosine) {
    return both(cosine) * normal + D2{-sine, sine} * swapped(normal);
}

}  // namespace

LaneVec3 Vibration::helical_force() {
    in_cut_.update(slices_, past_.samples(), spindle_.turn_rad());
    Vec3 force_n{};
    Edge edge;
    for (const EdgeInCut& in_cut : in_cut_.list()) {
        if (edge.before.empty() || edge.tooth != in_cut.tooth)
            edge = {in_cut.tooth, ahead_[in_cut.tooth](spindle_.sine_cosine()), past_.passages(in_cut.tooth)};
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
milling::TurnLaw Vibration::chip(const Edge& edge, const EdgePoint& point) {
    // A tool moves the point along its normal by its tip, by its turn, and by run-out of the tooth.
    const milling::ProfilePoint& at = point.at;
    const double by_tip = kRound ? at.sin_kappa : 1,
                 by_turn = kRound ? at.height_mm * at.sin_kappa + at.radius_mm * at.cos_kappa : at.height_mm;
    const D2 by_xy = both(by_tip) * point.normal, by_turn_xy = both(by_turn) * point.normal;
    const D2 by_runout = both(by_tip) * D2{point.lag.sine, point.lag.cosine};
    const bool runout = cutter_.runout_mm != 0;
    const auto height = [&](const ToolPast::Passage& p) {
        double h = sum(p.place.tip_mm.xy * by_xy + p.place.turn_rad * by_turn_xy);
        if constexpr (kRound) h -= p.place.tip_mm.z * at.cos_kappa;
        if (runout) h += sum(runout_mm_[past_.tooth_of(p, edge.tooth)] * by_runout);
        return h;
    };
    const ToolPast::Passage* highest = edge.before.data();
    if (edge.before.size() > 1) {
        double most = height(*highest);
        for (const ToolPast::Passage& p : edge.before.subspan(1)) {
            const double h = height(p);
            const bool higher = h > most;
            highest = higher ? &p : highest;
            most = higher ? h : most;
        }
    }
    const ToolPlace& there = highest->place;
    const D2 across = both(by_tip) * (place_.tip_mm.xy - there.tip_mm.xy) +
                      both(by_turn) * (place_.turn_rad - there.turn_rad);
    milling::TurnLaw law{across[0], across[1],
                         kRound ? (there.tip_mm.z - place_.tip_mm.z) * at.cos_kappa : 0};
    if (runout)
        law.constant +=
            sum((runout_mm_[edge.tooth] - runout_mm_[past_.tooth_of(*highest, edge.tooth)]) * by_runout);
    if (!(at_rotation(law, point.normal) > 0)) stands_clear(edge.tooth);
    return law;
}

double Vibration::straight_chip(std::size_t tooth, D2 normal) {
    const EdgePoint point{normal, {}, {.radius_mm = cutter_.radius_mm()}};
    return at_rotation(chip<false>({tooth, normal, past_.passages(tooth)}, point), normal);
}

Vec3 Vibration::piece_force(const Edge& edge, const EdgePiece& piece) {
    const D2 normal = behind(edge.tip, piece.lag.sine, piece.lag.cosine);
    const milling::TurnLaw law = chip<false>(edge, {normal, piece.lag, piece.middle});
    // At both ends.
    const milling::HalfSpan& half = piece.half;
    const double low = at_rotation(law, behind(normal, half.sine, half.cosine)),
                 high = at_rotation(law, behind(normal, -half.sine, half.cosine));
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
        if (at_rotation(law, normal) <= 0) continue;
        const milling::EdgeLoad load = milling::edge_load(coefficients_, law, node.at);
        force_n += node.length_mm * milling::force_at_rotation(load, normal[0], normal[1]).force_n;
    }
    return force_n;
}

}  // namespace tribo::dynamics
