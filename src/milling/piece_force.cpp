// SPDX-License-Identifier: MIT
#include "milling/piece_force.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "milling/profile_quadrature.hpp"

namespace tribo::milling {

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
    // Low rotations are high up on the edge.
    if (low < edge.entry_rad) {
        low = edge.entry_rad;
        z1 = std::min((tip_rad - low) / tool.lag_per_mm(), edge.z1_mm);
    }
    if (high > edge.exit_rad) {
        high = edge.exit_rad;
        z0 = std::max((tip_rad - high) / tool.lag_per_mm(), edge.z0_mm);
    }
    if (!edge.round) {
        const double height = edge.z1_mm - edge.z0_mm;
        return segment_force(edge.load, low, high, straight ? height : height * (high - low) / whole);
    }
    contact::ToolForce sum;
    visit_profile(tool, edge.chip, z0, z1, profile_rule(tool, z0, z1, 2 * (high - low)),
                  [&](double point_lag, const EdgeLoad& load) {
                      double sine, cosine;
                      math::sincos(tip_rad - point_lag, sine, cosine);
                      const contact::ToolForce f = force_at_rotation(load, sine, cosine);
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
