// SPDX-License-Identifier: MIT
// The force of one engaged piece of one tooth at one instant.
#pragma once

#include "contact/force_spectrum.hpp"
#include "milling/engagement/engaged_edges.hpp"

namespace tribo::milling {

// Returns the force of the tooth whose tip is at `tip_rad` (rotation, any turn): closed form on the cylinder,
// Gauss-Legendre along the profile in the rounded part. Zero if no part of the piece is within its window.
// Real-time safe.
contact::ToolForce piece_force(const EngagedEdges& tool, const EngagedEdge& edge, double tip_rad);

// The teeth whose piece is at least partly within its window at spindle angle theta. Their tips are at theta
// + phase + n * period for n from first to last (none: last < first).
struct ToothRange {
    int first, last;
};
ToothRange teeth_within(const EngagedEdge& edge, double theta_rad, double period_rad);

}  // namespace tribo::milling
