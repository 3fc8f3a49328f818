// SPDX-License-Identifier: MIT
// Turns engagement and travel into pieces of cutting edge with one chip law each. Force over time, spectrum
// and peaks are all computed from these pieces.
//
// An edge cuts where it meets material and moves into it (chip thickness above 0). With run-out or unequal
// pitch each tooth meets the surface that the deepest of the teeth before it left: the chip thickness is the
// least h over the last 1..N teeth (Kline and DeVor 1983). So the next tooth takes what one tooth misses, and
// the chips of all teeth add up to the feed per turn exactly. Run-out is a parallel offset of the axis. Its
// radii are constant over cells of lag (kRunoutCellRad); their error there is at most 1/16 of the offset.
#pragma once

#include <vector>

#include "contact/force_spectrum.hpp"
#include "milling/engagement/engagement.hpp"
#include "milling/force/edge_force.hpp"
#include "milling/tool/coefficients.hpp"
#include "milling/tool/cutter.hpp"
#include "milling/tool/cutter_profile.hpp"

namespace tribo::milling {

// Lag over which run-out counts as constant. The error of the force is at most cell^2 / 24, 0.3 % of the
// share of run-out.
inline constexpr double kRunoutCellRad = 0.125;
// Step of kappa, rad. The border of the cut is followed in these steps on a rounded part if the tool does not
// only move across its axis.
inline constexpr double kKappaStepRad = 0.06;
// The same on the arcs of a profile. There the chip may come to nothing on a long part of the edge, where the
// edge force ends at once: wider steps are off by 2 % of the force.
inline constexpr double kProfileStepRad = kKappaStepRad / 8;
// Where the axis turns, the feed grows along the edge. A piece of the cylinder is so short that the feed
// changes by at most this share of its largest value. A piece of the bottom is so short that its chips may be
// evaluated in the middle.
inline constexpr double kFeedStep = 0.08;
// A piece whose lag from end to end is below this counts as straight: all of it enters and leaves at once.
inline constexpr double kStraightRad = 1e-7;

// A piece between two heights or, on the flat bottom, between two radii. Both heights lie on the cylinder, or
// both lie in the rounded part. Every lateral part of a profile counts as round.
struct EngagedEdge {
    int part = -1;                       // of a cutter with a profile: the number of its part; else -1
    double z0_mm = 0, z1_mm = 0;         // 0 on the bottom
    double weight_mm = 0;                // factor on `load`: the height on the cylinder, 1 on the bottom
    double lag0_rad = 0, lag1_rad = 0;   // lag behind the tip, the smaller value first; equal if straight
    double entry_rad = 0, exit_rad = 0;  // 0 <= entry < exit <= 2 pi
    double phase_rad = 0;                // of its tooth, ahead of flute 0; 0 if all teeth share the piece
    bool round = false;
    Chip chip;
    EdgeLoad load;  // per mm height on the cylinder, of the whole piece on the bottom; unused if round
    double edge_torque_nmm = 0;  // of the edge coefficient kte alone, while the whole piece cuts

    bool straight() const { return lag1_rad - lag0_rad < kStraightRad; }
};

// The constants of the cutter and the pieces of one engagement. Copies are independent; one thread per
// object.
class EngagedEdges {
  public:
    // `cutter` and `coefficients` must pass their check(). Reserves memory for 64 pieces and, for a tool with
    // run-out or unequal pitch, for 16 per flute.
    EngagedEdges(const Cutter& cutter, const CuttingCoefficients& coefficients);

    // Replaces the pieces; `feed` is the mean travel of the tool from one tooth to the next. Real-time safe
    // while the pieces fit the memory of earlier calls or of reserve(). A band needs one or two pieces; a
    // band in the rounded part with axial feed needs one per kKappaStepRad. Run-out cells and flutes multiply
    // this number.
    void engage(const Engagement& engagement, const ToolTravel& feed);
    void reserve(std::size_t pieces) { edges_.reserve(pieces); }

    const std::vector<EngagedEdge>& edges() const { return edges_; }
    bool empty() const { return edges_.empty(); }
    // Coefficients of the lateral edge. On a left-hand helix kac and kae change sign, because the other end
    // of the edge leads.
    const CuttingCoefficients& coefficients() const { return k_; }
    int flutes() const { return flutes_; }
    // True if all teeth cut alike: the force repeats with each tooth, and every piece stands for all teeth.
    bool uniform() const { return uniform_; }
    double period_rad() const;  // period of the force: one tooth if uniform, else one turn
    double radius_mm() const { return radius_; }
    double corner_mm() const { return corner_; }
    const CutterProfile& profile() const { return profile_; }
    double lag_per_mm() const { return lag_per_mm_; }  // < 0 on a left-hand helix
    // Returns the mean torque over a turn of the edge coefficient kte alone, N mm. The rest of the mean
    // torque is ktc times the area of the chips.
    double mean_edge_torque_nmm() const;

  private:
    struct Part;
    void add_lateral(Part part, const ToolTravel& feed);
    void add_profile(Part part, const ToolTravel& feed);
    void add_bottom(const BottomBand& band, const ToolTravel& feed);
    void add_teeth(const Part& part, const ToolTravel& feed);
    void add_teeth_apart(const Part& part, const ToolTravel& feed, double lag);
    void add_window(const Part& part, const Chip& chip, double phase, double shift, double sine_low,
                    double sine_high);
    void push(const EngagedEdge& edge);

    CutterProfile profile_;
    CuttingCoefficients k_, bottom_k_;
    double radius_, corner_, lag_per_mm_;
    int flutes_;
    bool uniform_;
    double runout_, runout_rad_;
    std::vector<double> phase_;   // of each flute ahead of flute 0; the last entry is 2 pi
    std::vector<double> offset_;  // scratch: radius of each flute minus the mean radius
    std::vector<EngagedEdge> edges_;
};

}  // namespace tribo::milling
