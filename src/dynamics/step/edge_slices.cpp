// SPDX-License-Identifier: MIT
#include "dynamics/step/edge_slices.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "dynamics/step/spindle_turn.hpp"

namespace tribo::dynamics {
namespace {

// Points and weights of Gauss and Legendre on [-1, 1].
constexpr std::array<double, 4> kPoints{-0.86113631159405258, -0.33998104358485626, 0.33998104358485626,
                                        0.86113631159405258};
constexpr std::array<double, 4> kWeights{0.34785484513745386, 0.65214515486254614, 0.65214515486254614,
                                         0.34785484513745386};

}  // namespace

EdgeSlicer::EdgeSlicer(const milling::Cutter& cutter)
    : radius_mm_(cutter.radius_mm()), corner_mm_(cutter.corner_radius_mm()), lag_per_mm_(cutter.lag_rad(1)) {}

void EdgeSlicer::add(milling::EngagementBand band, std::vector<EdgeSlice>& slices) const {
    const double corner = std::clamp(corner_mm_, band.z0_mm, band.z1_mm), top = band.z1_mm;
    band.z1_mm = corner;
    add_slices(band, true, slices);
    band.z0_mm = corner;
    band.z1_mm = top;
    add_slices(band, false, slices);
}

void EdgeSlicer::add_slices(const milling::EngagementBand& band, bool round,
                            std::vector<EdgeSlice>& slices) const {
    const double height = band.z1_mm - band.z0_mm;
    if (!(height > 0)) return;
    double count = std::ceil(std::abs(lag_per_mm_) * height / kSliceRad);
    if (round) count = std::max(count, std::ceil((kappa(band.z1_mm) - kappa(band.z0_mm)) / kProfileRad));
    count = std::max(count, 1.0);
    for (int n = 0; n < static_cast<int>(count); ++n) {
        EdgeSlice slice;
        slice.band = band;
        slice.round = round;
        slice.width_rad = band.exit_rad - band.entry_rad;
        slice.span_rad = std::abs(lag_per_mm_) * height / count;
        slice.band.z0_mm = band.z0_mm + height * n / count;
        slice.band.z1_mm = band.z0_mm + height * (n + 1) / count;
        const EngagedZone all{slice.band.z0_mm, slice.band.z1_mm};
        slice.low_rad = in_turn(band.entry_rad + lag_per_mm_ * (lag_per_mm_ > 0 ? all.z1_mm : all.z0_mm));
        slice.middle_mm = 0.5 * (all.z0_mm + all.z1_mm);
        math::sincos(lag_per_mm_ * slice.middle_mm, slice.lag.sine, slice.lag.cosine);
        if (round) {
            slice.nodes = nodes(slice, all);
        } else {
            slice.whole = piece(slice, all);
        }
        slices.push_back(slice);
    }
}

EdgePiece EdgeSlicer::piece(const EdgeSlice& slice, EngagedZone zone) const {
    const double middle = 0.5 * (zone.z0_mm + zone.z1_mm), height = zone.z1_mm - zone.z0_mm;
    return {.middle = {.radius_mm = radius_mm_, .height_mm = middle},
            .lag = slice.lag.more(lag_per_mm_ * (middle - slice.middle_mm)),
            .height_mm = height,
            .half = milling::half_span(0.5 * std::abs(lag_per_mm_) * height)};
}

double EdgeSlicer::kappa(double z_mm) const {
    return math::acos(std::clamp(1 - z_mm / corner_mm_, -1.0, 1.0));
}

EdgeNodes EdgeSlicer::nodes(const EdgeSlice& slice, EngagedZone zone) const {
    const double from = kappa(zone.z0_mm), half = 0.5 * (kappa(zone.z1_mm) - from);
    double sine, cosine;
    math::sincos(from + half, sine, cosine);
    EdgeNodes nodes;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        EdgeNode& node = nodes[n];
        const milling::HalfSpan off = milling::half_span(half * kPoints[n]);
        node.at.sin_kappa = sine * off.cosine + cosine * off.sine;
        node.at.cos_kappa = cosine * off.cosine - sine * off.sine;
        node.at.radius_mm = radius_mm_ - corner_mm_ * (1 - node.at.sin_kappa);
        node.at.height_mm = corner_mm_ * (1 - node.at.cos_kappa);
        node.lag = slice.lag.more(lag_per_mm_ * (node.at.height_mm - slice.middle_mm));
        node.length_mm = half * kWeights[n] * corner_mm_;
    }
    return nodes;
}

}  // namespace tribo::dynamics
