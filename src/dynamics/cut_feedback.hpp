// SPDX-License-Identifier: MIT
// A steady cut as feedback: how the force changes where the tool is displaced now, and was a tooth before.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/vec3.hpp"
#include "dynamics/engaged_zone.hpp"
#include "milling/engagement/engagement.hpp"
#include "milling/tool/coefficients.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::dynamics {

// A matrix of N/mm by rows: force over displacement.
using Matrix3 = std::array<Vec3, 3>;

// F(t) = sum over the teeth j of S_j(t) (r(t) - r(t - delay_j)): the chip of a tooth grows by the
// displacement r along its outward normal, less that of the tooth before it at the same angle (Altintas and
// Budak 1995, eq. 5 to 9, here as a function of time and integrated over a helix). Frame: x along the feed, y
// to its left, z to the shank; signs as in milling/force/edge_force.hpp. Run-out and the loss of contact are
// left out: a small vibration meets neither. Any thread.
class CutFeedback {
  public:
    // `cutter` and `coefficients` must pass their check(); 0 < spindle_rpm. The bands of the lateral edge
    // only.
    CutFeedback(const milling::Cutter& cutter, const milling::CuttingCoefficients& coefficients,
                std::span<const milling::EngagementBand> bands, double spindle_rpm);

    // Period of the pattern of the pitches: one tooth with equal pitches, at most a turn.
    double period_s() const { return period_s_; }
    int teeth() const { return static_cast<int>(delay_s_.size()); }
    // Time since another tooth stood where this one is now.
    double delay_s(int tooth) const { return delay_s_[static_cast<std::size_t>(tooth)]; }
    // S of one tooth at a time.
    Matrix3 stiffness(int tooth, double t_s) const;
    // How stiff the cut is at a time: a bound of the force over the displacement, N/mm.
    double spring(double t_s) const;
    // Times from 0 to the period at which a piece of an edge begins or stops to cut, ascending, with both
    // ends. Between two of them S is smooth.
    const std::vector<double>& events_s() const { return events_s_; }
    // True if any tooth cuts at this time.
    bool cuts(double t_s) const;

  private:
    // The parts of the bands in which a tooth at that rotation cuts.
    template <class Use>
    void for_each_zone(double rotation_rad, Use&& use) const;
    double rotation(int tooth, double t_s) const;
    // Adds S of a piece of one edge: below the rounded part's top, and above it.
    void add_rounded(double rotation_rad, EngagedZone cut, Matrix3& sum) const;
    void add_straight(double tip_sine, double tip_cosine, EngagedZone cut, Matrix3& sum) const;
    void find_events();

    milling::Cutter cutter_;
    milling::CuttingCoefficients coefficients_;
    std::vector<milling::EngagementBand> bands_;
    double turn_rad_per_s_, lag_per_mm_, period_s_ = 0;
    std::vector<double> phase_rad_, delay_s_, events_s_;
};

}  // namespace tribo::dynamics
