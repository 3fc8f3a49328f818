// SPDX-License-Identifier: MIT
// The force of one engaged piece of one tooth at one instant.
#pragma once

#include "contact/force_spectrum.hpp"
#include "milling/engagement/engaged_edges.hpp"

namespace tribo::milling {

// Of the tooth whose tip stands at `tip_rad` (rotation, any turn): closed form on the cylinder,
// Gauss-Legendre along the profile in the rounded part; zero where nothing of the piece is within its window.
// Real-time safe.
contact::ToolForce piece_force(const EngagedEdges& tool, const EngagedEdge& edge, double tip_rad);

// The teeth whose part of this piece is within its window, at least in part, at spindle angle theta: tips
// stand at theta + phase + n * period for n from first to last (none: last < first).
struct ToothRange {
    int first, last;
};
ToothRange teeth_within(const EngagedEdge& edge, double theta_rad, double period_rad);

}  // namespace tribo::milling
