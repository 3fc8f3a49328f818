// SPDX-License-Identifier: MIT
// The vibration of a program: simulated in time, row after row.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dynamics/vibration.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

// Follows the rows of a program with one dynamics::Vibration, at kVibrationHz (simulated_cut.hpp). It starts
// at rest at the first row, after a gap in which everything dies out, and with another cutter. Its frame is
// that of the stock, turned by the shortest rotation to the tool axis. Where the tool moves farther than
// kLargestDisplacement, the modes are held there. One thread.
class RowSimulation {
  public:
    // All arguments must outlive this object.
    RowSimulation(const MillSetup& setup, std::span<const dynamics::Mode> modes);

    // Simulates the samples n / kVibrationHz from the start of the row to its end. Rows come in the order of
    // time. Edges of a flat bottom are left out. Returns the largest displacement, mm; nothing for a row in
    // which a machine tilts the tool, or its teeth follow each other by more than kLongestPitchS.
    std::optional<double> run(const milling::CutRow& row);

    static constexpr double kLongestPitchS = 4;

    // The tool was held in the last row.
    bool was_held() const { return held_; }

  private:
    void start(const milling::CutRow& row);
    void engage(const milling::CutRow& row, std::span<const milling::EngagementBand> bands);
    double run_to(double end_s);                        // returns the largest displacement, mm
    double feed_rad(const milling::CutRow& row) const;  // from x of frame_ to that of the row

    const MillSetup& setup_;
    std::span<const dynamics::Mode> modes_;
    double ring_s_ = 0;       // a vibration dies out in it
    std::vector<int> steps_;  // per sample, of each cutter at its highest speed
    std::optional<dynamics::Vibration> vibration_;
    milling::ToolFrame frame_;  // of the vibration
    std::size_t cutter_ = 0;
    std::int64_t next_ = 0;  // sample
    double last_end_s_ = 0;
    double displacement_mm_ = 0;  // at the last sample
    bool held_ = false;
};

}  // namespace tribo::session
