// SPDX-License-Identifier: MIT
// The cutting force over a turn of the spindle: at an instant, as harmonics, and its extremes.
//
// There are two interfaces. For a single use: the free functions. For repeated use (a row per millimetre, a
// servo tick): ForceModel, which keeps the constants of the cutter and its memory. Frame and signs as in
// edge_force.hpp. theta is the rotation of the tip of flute 0, clockwise seen from the shank, from y.
#pragma once

#include "contact/force_spectrum.hpp"
#include "milling/engagement/engaged_edges.hpp"
#include "milling/force/force_peaks.hpp"

namespace tribo::milling {

// Returns the force on the tool at spindle angle theta, from the closed form over time. (The sum of the
// spectrum rings at the jumps of edge forces; this form does not.) Real-time safe.
contact::ToolForce force_at(const EngagedEdges& edges, double theta_rad);

// Returns the mean over a turn: harmonic 0 of the spectrum. Real-time safe.
contact::ToolForce mean_force(const EngagedEdges& edges);

// Computes complex harmonics in closed form (README, "One force spectrum"): the mean and `tooth_harmonics`
// multiples of the tooth frequency. With run-out or unequal pitch: every multiple of the spindle frequency up
// to the same highest frequency. `out` has no harmonics if nothing cuts. Real-time safe if `out` has the
// memory.
void force_spectrum(const EngagedEdges& edges, int tooth_harmonics, contact::ForceSpectrum& out);

// One thread per object; copies are independent.
class ForceModel {
  public:
    // `cutter` and `coefficients` must pass their check().
    ForceModel(const Cutter& cutter, const CuttingCoefficients& coefficients)
        : edges_(cutter, coefficients) {}

    // Sets the engagement for the following calls. Real-time safe within the memory of EngagedEdges.
    void engage(const Engagement& engagement, const ToolTravel& feed) { edges_.engage(engagement, feed); }

    // Real-time safe.
    contact::ToolForce at(double theta_rad) const { return force_at(edges_, theta_rad); }
    contact::ToolForce mean() const { return mean_force(edges_); }
    // Real-time safe if `out` has the memory.
    void spectrum(int tooth_harmonics, contact::ForceSpectrum& out) const {
        force_spectrum(edges_, tooth_harmonics, out);
    }
    // Real-time safe once it has processed as many pieces.
    ForcePeaks peaks() { return peaks_.find(edges_); }

    const EngagedEdges& edges() const { return edges_; }

  private:
    EngagedEdges edges_;
    PeakFinder peaks_;
};

// For a single use.
void force_spectrum(const Cutter& cutter, const CuttingCoefficients& coefficients,
                    const Engagement& engagement, const ToolTravel& feed, int tooth_harmonics,
                    contact::ForceSpectrum& out);

}  // namespace tribo::milling
