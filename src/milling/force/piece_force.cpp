// SPDX-License-Identifier: MIT
#include "milling/force/piece_force.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "milling/force/profile_quadrature.hpp"

namespace tribo::milling {
namespace {

// Up to this angle a Taylor series is used, accurate to 1e-14.
constexpr double kSmallTurnRad = 0.12;

void small_sincos(double x, double& sine, double& cosine) {
    const double z = x * x;
    sine = x * (1 - z * (1.0 / 6) * (1 - z * (1.0 / 20) * (1 - z * (1.0 / 42))));
    cosine = 1 - z * 0.5 * (1 - z * (1.0 / 12) * (1 - z * (1.0 / 30) * (1 - z * (1.0 / 56))));
}

}  // namespace

contact::ToolForce piece_force(const EngagedEdges& tool, const EngagedEdge& edge, double tip_rad) {
    const bool straight = edge.straight();
    const double lag = 0.5 * (edge.lag0_rad + edge.lag1_rad);
    double low = tip_rad - (straight ? lag : edge.lag1_rad),
           high = tip_rad - (straight ? lag : edge.lag0_rad);
    if (straight ? low < edge.entry_rad || low >= edge.exit_rad
                 : high <= edge.entry_rad || low >= edge.exit_rad) {
        return {};
    }
    double z0 = edge.z0_mm, z1 = edge.z1_mm;
    const double whole = high - low;
    // A right-hand helix lags more with height; a left-hand helix runs ahead, so that its low rotations are
    // at low heights.
    const bool left_hand = tool.lag_per_mm() < 0;
    const auto height_at = [&](double rotation) {
        return std::clamp((tip_rad - rotation) / tool.lag_per_mm(), edge.z0_mm, edge.z1_mm);
    };
    if (low < edge.entry_rad) {
        low = edge.entry_rad;
        (left_hand ? z0 : z1) = height_at(low);
    }
    if (high > edge.exit_rad) {
        high = edge.exit_rad;
        (left_hand ? z1 : z0) = height_at(high);
    }
    if (!edge.round) {
        return segment_force(edge.load, low, high,
                             straight ? edge.weight_mm : edge.weight_mm * (high - low) / whole);
    }
    // The rotations of the points are close together: one sine and cosine for the middle, then small turns
    // from there.
    const double middle = 0.5 * (low + high);
    double sin_middle, cos_middle;
    math::sincos(middle, sin_middle, cos_middle);
    const bool small = high - low < 2 * kSmallTurnRad;
    contact::ToolForce sum;
    visit_profile(tool, edge.chip, z0, z1, profile_rule(tool, z0, z1, 2 * (high - low)),
                  [&](double point_lag, const EdgeLoad& load) {
                      const double turn = tip_rad - point_lag - middle;
                      double s, c;
                      if (small) {
                          small_sincos(turn, s, c);
                      } else {
                          math::sincos(turn, s, c);
                      }
                      const contact::ToolForce f = force_at_rotation(load, sin_middle * c + cos_middle * s,
                                                                     cos_middle * c - sin_middle * s);
                      sum.force_n += f.force_n;
                      sum.torque_nmm += f.torque_nmm;
                  });
    return sum;
}

ToothRange teeth_within(const EngagedEdge& edge, double theta_rad, double period_rad) {
    const double ahead = theta_rad + edge.phase_rad;
    return {static_cast<int>(std::ceil((edge.entry_rad + edge.lag0_rad - ahead) / period_rad)),
            static_cast<int>(std::floor((edge.exit_rad + edge.lag1_rad - ahead) / period_rad))};
}

}  // namespace tribo::milling
