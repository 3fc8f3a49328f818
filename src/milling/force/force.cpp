// SPDX-License-Identifier: MIT
#include "milling/force/force.hpp"

#include "milling/force/piece_force.hpp"

namespace tribo::milling {

contact::ToolForce force_at(const EngagedEdges& tool, double theta_rad) {
    contact::ToolForce sum;
    const double period = tool.period_rad();
    for (const EngagedEdge& edge : tool.edges()) {
        const ToothRange teeth = teeth_within(edge, theta_rad, period);
        for (int n = teeth.first; n <= teeth.last; ++n) {
            const contact::ToolForce f = piece_force(tool, edge, theta_rad + edge.phase_rad + n * period);
            sum.force_n += f.force_n;
            sum.torque_nmm += f.torque_nmm;
        }
    }
    return sum;
}

void force_spectrum(const Cutter& cutter, const CuttingCoefficients& coefficients,
                    const Engagement& engagement, const ToolTravel& feed, int tooth_harmonics,
                    contact::ForceSpectrum& out) {
    EngagedEdges edges(cutter, coefficients);
    edges.engage(engagement, feed);
    force_spectrum(edges, tooth_harmonics, out);
}

}  // namespace tribo::milling
