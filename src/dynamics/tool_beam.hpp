// SPDX-License-Identifier: MIT
// A tool as a stepped round beam, and how it bends under a steady force across its axis.
#pragma once

#include <vector>

#include "dynamics/beam.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::dynamics {

// The bar that bends as much as the edges do, over their diameter (Kops and Vo 1990).
inline constexpr double kFlutedShare = 0.8;

// From the tip up. The body is held by the holder, the holder by the spindle.
struct ToolBeam {
    std::vector<BeamSection> body;    // never empty: edges, neck and shank
    std::vector<BeamSection> holder;  // of steel; may be empty
};

// Without a stick-out the body ends with the edges.
ToolBeam tool_beam(const milling::Cutter& cutter);

// Of a force of 1 N.
struct BendingByForce {
    double stress_per_mm2 = 0;    // the largest bending stress of the body, N/mm2
    double stress_height_mm = 0;  // above the tip
    double yield_mm = 0;          // by how much the tip moves
};

// The force acts across the axis at a height above the tip, on a beam whose upper end is clamped (Euler and
// Bernoulli: no shear, no joints). Of tip displacement and stress in closed form. A force above the beam
// bends nothing. Any thread; does not allocate.
BendingByForce bending_by_force(const ToolBeam& beam, double height_mm);

// By how much the same beam moves at `at_mm` above the tip under a force of 1 N at `force_mm`, mm/N.
double yield_mm_per_n(const ToolBeam& beam, double force_mm, double at_mm);

}  // namespace tribo::dynamics
