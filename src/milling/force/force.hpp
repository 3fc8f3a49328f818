// SPDX-License-Identifier: MIT
// The cutting force over a turn of the spindle: at an instant, as harmonics, and its extremes.
//
// Two doors. One use: the free functions. A row per millimetre or a tick of a servo: a ForceModel, which
// keeps the cutter's constants and its room. Frame and signs as in edge_force.hpp; theta is where flute 0's
// tip stands, clockwise seen from the shank, from y.
#pragma once

#include "contact/force_spectrum.hpp"
#include "milling/engagement/engaged_edges.hpp"
#include "milling/force/force_peaks.hpp"

namespace tribo::milling {

// Force on the tool at spindle angle theta, out of the closed form over time (the spectrum's sum rings at the
// jumps of edge forces; this does not). Real-time safe.
contact::ToolForce force_at(const EngagedEdges& edges, double theta_rad);

// Mean over a turn: the spectrum's first harmonic. Real-time safe.
contact::ToolForce mean_force(const EngagedEdges& edges);

// Complex harmonics in closed form (README, "One force spectrum"): the mean and `tooth_harmonics` multiples
// of the tooth frequency; with run-out or unequal pitch every multiple of the spindle's frequency up to the
// same highest. `out` is left without harmonics when nothing cuts. Real-time safe when `out` has the room.
void force_spectrum(const EngagedEdges& edges, int tooth_harmonics, contact::ForceSpectrum& out);

// One thread per object; copies are independent.
class ForceModel {
  public:
    // `cutter` and `coefficients` as their check() accepts them.
    ForceModel(const Cutter& cutter, const CuttingCoefficients& coefficients)
        : edges_(cutter, coefficients) {}

    // What cuts from now on. Real-time safe within the room of EngagedEdges.
    void engage(const Engagement& engagement, const ToolTravel& feed) { edges_.engage(engagement, feed); }

    // Real-time safe.
    contact::ToolForce at(double theta_rad) const { return force_at(edges_, theta_rad); }
    contact::ToolForce mean() const { return mean_force(edges_); }
    // Real-time safe when `out` has the room.
    void spectrum(int tooth_harmonics, contact::ForceSpectrum& out) const {
        force_spectrum(edges_, tooth_harmonics, out);
    }
    // Real-time safe once it has seen as many pieces.
    ForcePeaks peaks() { return peaks_.find(edges_); }

    const EngagedEdges& edges() const { return edges_; }

  private:
    EngagedEdges edges_;
    PeakFinder peaks_;
};

// The one-use doors.
void force_spectrum(const Cutter& cutter, const CuttingCoefficients& coefficients,
                    const Engagement& engagement, const ToolTravel& feed, int tooth_harmonics,
                    contact::ForceSpectrum& out);
ForcePeaks force_peaks(const Cutter& cutter, const CuttingCoefficients& coefficients,
                       const Engagement& engagement, const ToolTravel& feed);

}  // namespace tribo::milling
