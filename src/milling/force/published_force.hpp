// SPDX-License-Identifier: MIT
// Equations 1 to 5 of the paper that this project starts from: {F} = [K]{A} (a flat end mill after Abrari and
// Elbestawi 1997), as printed and corrected. docs/printed-model.md lists the differences with reasons. The
// engine itself uses force.hpp.
#pragma once

#include <span>

#include "base/result.hpp"
#include "base/vec3.hpp"
#include "milling/engagement/engaged_edges.hpp"
#include "milling/force/force_peaks.hpp"

namespace tribo::milling {

enum class PublishedForm {
    printed,   // letter by letter; the result is in N mm2
    corrected  // one R f removed, half sums in {A}, three signs: N on the tool
};

// The constants of equation 2. `eta_r` is the ratio of radial to tangential pressure. eta_r K_r is read as
// eta_r K_t (as printed the ratio would count twice).
struct PublishedCut {
    double radius_mm = 0, feed_per_tooth_mm = 0, helix_rad = 0;
    double kt_n_per_mm2 = 0, eta_r = 0;
};

// Computes the constants from a library material: Ktc = Kt, Krc = eta_r Kt / cos(helix). Refuses cutters
// other than flat, and helix 0, where the equations divide by zero.
Result<PublishedCut> published_cut(const Cutter& cutter, const CuttingCoefficients& coefficients,
                                   double feed_per_tooth_mm);

// phi_ent and phi_ext of the piece of one flute that is engaged at this instant (not of the cut), entry <=
// exit.
struct FluteSpan {
    double entry_rad = 0, exit_rad = 0;
};

// Returns {F} in the order of the paper: feed, tool axis (its y), in-plane normal to the feed (its z).
Vec3 published_force(PublishedForm form, const PublishedCut& cut, std::span<const FluteSpan> flutes);

// Returns the force of all flutes at spindle angle theta, in the tool's frame (x feed, y normal, z axis).
Vec3 published_force_at(PublishedForm form, const PublishedCut& cut, const EngagedEdges& edges,
                        double theta_rad);

// Returns mean and extremes over a turn, sampled. Without torque: the equations have none.
ForcePeaks published_peaks(PublishedForm form, const PublishedCut& cut, const EngagedEdges& edges);

}  // namespace tribo::milling
