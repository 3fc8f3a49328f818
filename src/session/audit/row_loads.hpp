// SPDX-License-Identifier: MIT
// The loads of a row of a cut, and the share of their limits that they reach.
#pragma once

#include <span>
#include <vector>

#include "dynamics/tool_beam.hpp"
#include "milling/engagement/cut_row.hpp"
#include "milling/force/force_peaks.hpp"
#include "session/audit/cut_limits.hpp"

namespace tribo::session {

// In the order of LoadKind. Force, torque, stress and deflection are the largest within a turn, the power is
// its mean, the chip the thickest one.
struct RowLoads {
    std::array<double, kLoadKinds> value{};  // in the unit of kLoadWords
    std::array<double, kLoadKinds> ratio{};  // to the limit; 0 without one
};

// The true ratio lies between `low` and `high`.
struct RatioBand {
    double low = 0, value = 0, high = 0;
};

// The constants of all cutters of a run. Any thread; the functions do not allocate.
class LoadModel {
  public:
    // The setup must have its cutters.
    LoadModel(const MillSetup& setup, CutLimits limits);

    // `peaks` may be those of another feed than the row's. Without multiplier.
    RowLoads loads(const milling::CutRow& row, const milling::ForcePeaks& peaks, double chip_mm) const;
    void add_multiplier(std::size_t cutter, double multiplier, RowLoads& loads) const;

    // The band of a ratio: that of the force and that of the limit.
    RatioBand band(std::size_t cutter, LoadKind kind, double ratio) const;
    // The band of a load over the stated limit, widened by that of the limit.
    RatioBand with_limit(std::size_t cutter, LoadKind kind, RatioBand ratio) const;
    const CutLimits& limits() const { return limits_; }
    // Band of all forces: factors on them. By default that of the setup.
    double force_low_factor() const { return force_low_; }
    double force_high_factor() const { return force_high_; }
    void set_force_band(double low_factor, double high_factor) {
        force_low_ = low_factor;
        force_high_ = high_factor;
    }

  private:
    CutLimits limits_;
    double force_low_, force_high_;
    std::vector<dynamics::ToolBeam> beams_;  // one per cutter
};

}  // namespace tribo::session
