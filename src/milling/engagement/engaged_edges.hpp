// SPDX-License-Identifier: MIT
// Engagement and travel turned into pieces of cutting edge that each meet one chip law: the common ground of
// force over time, spectrum and peaks.
//
// An edge cuts where it meets material and moves into it (chip thickness above 0). With run-out or unequal
// pitch each tooth meets the surface that the deepest of the teeth before left: the least of h over the last
// 1..N teeth (Kline and DeVor 1983), so what a tooth misses is left for the next, and the chips of all teeth
// add up to the feed per turn exactly. Run-out is a parallel offset of the axis; its radii are held constant
// over cells of lag (kRunoutCellRad), where they are off by at most 1/16 of the offset.
#pragma once

#include <vector>

#include "contact/force_spectrum.hpp"
#include "milling/engagement/engagement.hpp"
#include "milling/force/edge_force.hpp"
#include "milling/tool/coefficients.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::milling {

// Lag over which run-out counts as constant: its force is off by at most cell^2 / 24, 0.3 % of run-out's
// share.
inline constexpr double kRunoutCellRad = 0.125;
// Step of kappa in which the border of the cut is followed on a rounded part that does not only move across
// its axis, rad.
inline constexpr double kKappaStepRad = 0.06;
// Where the axis turns the feed grows along the edge: a piece of the cylinder is so short that it changes by
// at most this share of the largest, a piece of the bottom that its chips may be judged in the middle.
inline constexpr double kFeedStep = 0.08;
// Below this lag from end to end a piece counts as straight: it enters and leaves all at once.
inline constexpr double kStraightRad = 1e-7;

// A piece between two heights that lie both on the cylinder or both in the rounded part, or between two radii
// of the flat bottom.
struct EngagedEdge {
    double z0_mm = 0, z1_mm = 0;         // 0 on the bottom
    double weight_mm = 0;                // what `load` is multiplied by: the height; 1 on the bottom
    double lag0_rad = 0, lag1_rad = 0;   // behind the tip, the lesser first; equal when straight
    double entry_rad = 0, exit_rad = 0;  // 0 <= entry < exit <= 2 pi
    double phase_rad = 0;                // of its tooth ahead of flute 0; 0 where all teeth share it
    bool round = false;
    Chip chip;
    EdgeLoad load;  // per mm height on the cylinder, of the whole piece on the bottom (round: it varies)
    double edge_torque_nmm = 0;  // of the edge coefficient kte alone while the whole piece cuts

    bool straight() const { return lag1_rad - lag0_rad < kStraightRad; }
};

// The cutter's constants and the pieces for one engagement. Copies are independent; one thread per object.
class EngagedEdges {
  public:
    // `cutter` and `coefficients` as their check() accepts them. Reserves room for 64 pieces and, for a tool
    // with run-out or unequal pitch, 16 per flute.
    EngagedEdges(const Cutter& cutter, const CuttingCoefficients& coefficients);

    // Replaces the pieces; `feed` is the tool's mean travel from one tooth to the next. Real-time safe while
    // they fit the room that earlier calls or reserve() made: a band is one piece or two, in the rounded part
    // with axial feed one per kKappaStepRad, and each is multiplied by run-out cells and flutes.
    void engage(const Engagement& engagement, const ToolTravel& feed);
    void reserve(std::size_t pieces) { edges_.reserve(pieces); }

    const std::vector<EngagedEdge>& edges() const { return edges_; }
    bool empty() const { return edges_.empty(); }
    // Of the lateral edge: on a left-hand helix kac and kae change sign, as the edge's other end leads.
    const CuttingCoefficients& coefficients() const { return k_; }
    int flutes() const { return flutes_; }
    // All teeth cut alike: the force repeats with the tooth, and every piece stands for all teeth.
    bool uniform() const { return uniform_; }
    double period_rad() const;  // of the force: a tooth when uniform, else the turn
    double radius_mm() const { return radius_; }
    double corner_mm() const { return corner_; }
    double lag_per_mm() const { return lag_per_mm_; }  // < 0 on a left-hand helix
    // Mean over a turn of the torque that the edge coefficient kte alone asks for, N mm: the rest of the mean
    // torque is ktc times the chips' area.
    double mean_edge_torque_nmm() const;

  private:
    struct Part;
    void add_lateral(Part part, const ToolTravel& feed);
    void add_bottom(const BottomBand& band, const ToolTravel& feed);
    void add_teeth(const Part& part, const ToolTravel& feed);
    void add_teeth_apart(const Part& part, const ToolTravel& feed, double lag);
    void add_window(const Part& part, const Chip& chip, double phase, double shift, double sine_low,
                    double sine_high);
    void push(const EngagedEdge& edge);

    CuttingCoefficients k_, bottom_k_;
    double radius_, corner_, lag_per_mm_;
    int flutes_;
    bool uniform_;
    double runout_, runout_rad_;
    std::vector<double> phase_;   // of each flute ahead of flute 0, and 2 pi at the end
    std::vector<double> offset_;  // scratch: radius of each flute above the mean
    std::vector<EngagedEdge> edges_;
};

}  // namespace tribo::milling
