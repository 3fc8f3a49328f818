// SPDX-License-Identifier: MIT
// The force of the paper that this project starts from, its equations 1 to 5: {F} = [K]{A} (a flat end mill
// after Abrari and Elbestawi 1997), as printed and as it must have been meant. docs/printed-model.md says
// what differs and why. Not what the engine uses: that is force.hpp.
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

// The constants of equation 2. `eta_r` is the ratio of radial to tangential pressure, with eta_r K_r read as
// eta_r K_t (as printed the ratio would count twice).
struct PublishedCut {
    double radius_mm = 0, feed_per_tooth_mm = 0, helix_rad = 0;
    double kt_n_per_mm2 = 0, eta_r = 0;
};

// The constants out of a library material: Ktc = Kt, Krc = eta_r Kt / cos(helix). Refuses what the equations
// cannot do: cutters other than flat, and helix 0, where they divide by zero.
Result<PublishedCut> published_cut(const Cutter& cutter, const CuttingCoefficients& coefficients,
                                   double feed_per_tooth_mm);

// phi_ent and phi_ext of the piece of one flute that is engaged now (not of the cut), entry <= exit.
struct FluteSpan {
    double entry_rad = 0, exit_rad = 0;
};

// {F} in the paper's own order: feed, tool axis (its y), in-plane normal to the feed (its z).
Vec3 published_force(PublishedForm form, const PublishedCut& cut, std::span<const FluteSpan> flutes);

// The same for all flutes at spindle angle theta, in the tool's frame (x feed, y normal, z axis).
Vec3 published_force_at(PublishedForm form, const PublishedCut& cut, const EngagedEdges& edges,
                        double theta_rad);

// Mean and extremes over a turn, sampled; the equations know no torque.
ForcePeaks published_peaks(PublishedForm form, const PublishedCut& cut, const EngagedEdges& edges);

}  // namespace tribo::milling
