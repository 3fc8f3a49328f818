// SPDX-License-Identifier: MIT
// A tool and a part that vibrate while they cut, step by step in time, with teeth that leave the cut.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec3.hpp"
#include "dynamics/mode.hpp"
#include "dynamics/step/edge_slices.hpp"
#include "dynamics/step/edges_in_cut.hpp"
#include "dynamics/step/modal_steps.hpp"
#include "dynamics/step/spindle_turn.hpp"
#include "dynamics/step/tool_past.hpp"
#include "milling/engagement/engagement.hpp"
#include "milling/force/edge_force.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::dynamics {

struct VibrationSample {
    Vec3 displacement_mm;  // of the tool against the part
    Vec3 force_n;          // on the tool
};

// Samples per second that are enough for a cut: 20 to a cycle of each mode, 8 from tooth to tooth.
double enough_rate_hz(std::span<const Mode> modes, const milling::Cutter& cutter, double spindle_rpm);

// The chip of a tooth is the distance by which it stands beyond the surface that the teeth before it left,
// each where the tool was displaced then: the least over those since one that cut there. Where it is negative
// there is no chip (Tlusty and Ismail 1981). So teeth jump out of the cut, and chatter stays bounded. Frame
// and signs as in milling/force/edge_force.hpp: x along the feed, y to its left, z to the shank.
//
// A step turns the modes exactly under a constant force: that of the middle of the step, for the displacement
// which the force before foretells there. A straight edge that enters or leaves within the step counts by its
// share of it. Samples stand in the middles of the steps. One thread.
class Vibration {
  public:
    // At rest, with flute 0 at `rotation_rad` from y. `cutter` and `coefficients` must pass their check().
    // rate_hz: samples per second, some tens of times the frequency of each mode. Directions of the modes in
    // the frame of the vibration; no modes: a rigid tool.
    Vibration(std::span<const Mode> modes, const milling::Cutter& cutter,
              const milling::CuttingCoefficients& coefficients, double rate_hz, double rotation_rad = 0);

    // The cut from the next sample on: bands of the lateral edge, mean travel per tooth, speed > 0 with at
    // least four samples from tooth to tooth. Bands and travel are in the frame of the feed, whose x is
    // `feed_rad` from that of the vibration, counterclockwise seen from the shank. What the teeth left before
    // stays. Allocates for more bands or a lower speed than before.
    void engage(std::span<const milling::EngagementBand> bands, const milling::ToolTravel& per_tooth,
                double spindle_rpm, double feed_rad = 0);
    // Another speed from the next sample on. Allocates for a lower one than before.
    void turn_at(double spindle_rpm);
    // Other directions of the modes, as many as there are: the frame of the vibration turned against them.
    void turn_modes(std::span<const Mode> modes);

    // Multiplies displacement and speed of the modes.
    void scale_modes(double factor);

    // The next sample. The first is at rest. Real-time safe.
    VibrationSample step();

    // Rotation of the next sample, from that at the start on.
    double rotation_rad() const { return spindle_.rotation_rad(); }

  private:
    // A tooth of a straight edge in the cut.
    struct StraightTooth {
        std::size_t tooth = 0;
        TeethThatCut before = 0;        // the bit of the tooth before it
        double outward_mm = 0;          // by run-out, than that one
        Turner normal, per_mm, edge_n;  // of the chip; of the force across the axis by mm of it
        double axial_per_mm = 0, axial_n = 0;
        double now = 1;  // force in the middle of the step over its mean
    };
    // The edge of a tooth at this sample.
    struct Edge {
        std::size_t tooth = 0;
        D2 tip{};  // sine and cosine of its rotation at the tip
        std::span<const ToolPast::Passage> before;
    };
    // A point of it.
    struct EdgePoint {
        D2 normal{};  // sine and cosine of its rotation
        Lag lag;
        milling::ProfilePoint at;
    };

    void gather_straight_teeth();
    LaneVec3 straight_force(D2 place_mm);
    LaneVec3 helical_force();
    Vec3 piece_force(const Edge& edge, const EdgePiece& piece);
    Vec3 nodes_force(const Edge& edge, const EdgeNodes& nodes);
    // The law of the chip over the surface that stands highest there.
    template <bool kRound>
    milling::TurnLaw chip(const Edge& edge, const EdgePoint& point);
    double straight_chip(std::size_t tooth, D2 normal);
    void stands_clear(std::size_t tooth) { cut_ &= ~tooth_bit(tooth); }

    milling::Cutter cutter_;
    milling::CuttingCoefficients coefficients_;
    double rate_hz_;
    bool straight_;  // a cylinder without helix: one angle for all bands
    EdgeSlicer slicer_;
    // Of each tooth: its angle ahead of flute 0, and its run-out by sine and cosine of a lag.
    std::vector<double> phase_rad_;
    std::vector<Turner> ahead_;
    std::vector<D2> runout_mm_;

    ModalSteps modes_;
    SpindleTurn spindle_;
    ToolPast past_;
    std::vector<EdgeSlice> slices_;
    EdgesInCut in_cut_;
    std::vector<StraightTooth> straight_teeth_;
    // At this sample, as foreseen.
    ToolPlace place_;
    TeethThatCut cut_ = 0;
    // Force in the middle of the step less its mean: where a straight edge enters or leaves.
    LaneVec3 off_mean_n_;
};

}  // namespace tribo::dynamics
