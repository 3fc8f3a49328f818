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
    return both(cosine) * normal + D2{-sine, sine} * D2{normal[1], normal[0]};
}

}  // namespace

LaneVec3 Vibration::helical_force() {
    in_cut_.update(past_.samples(), spindle_.turn_rad());
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
milling::TurnLaw Vibration::outward(const ToolPlace& place, std::size_t tooth, const EdgePoint& point) const {
    const milling::ProfilePoint& at = point.at;
    D2 xy = place.tip_mm.xy;
    if constexpr (kRound) xy *= both(at.sin_kappa);
    if (past_.turns()) {
        const double arm = kRound ? at.height_mm * at.sin_kappa + at.radius_mm * at.cos_kappa : at.height_mm;
        xy += both(arm) * place.turn_rad;
    }
    milling::TurnLaw law{xy[0], xy[1], 0};
    if (cutter_.runout_mm != 0)
        law.constant = at.sin_kappa * sum(runout_mm_[tooth] * D2{point.lag.sine, point.lag.cosine});
    if constexpr (kRound) law.constant -= place.tip_mm.z * at.cos_kappa;
    return law;
}

template <bool kRound>
milling::TurnLaw Vibration::chip(const Edge& edge, const EdgePoint& point) {
    milling::TurnLaw highest;
    double most = -std::numeric_limits<double>::infinity();
    for (const ToolPast::Passage& p : edge.before) {
        const milling::TurnLaw law = outward<kRound>(p.place, past_.tooth_of(p, edge.tooth), point);
        const double height = at_rotation(law, point.normal);
        if (height <= most) continue;
        highest = law;
        most = height;
    }
    const milling::TurnLaw own = outward<kRound>(place_, edge.tooth, point);
    const milling::TurnLaw chip{own.sine - highest.sine, own.cosine - highest.cosine,
                                own.constant - highest.constant};
    if (!(at_rotation(chip, point.normal) > 0)) stands_clear(edge.tooth);
    return chip;
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
