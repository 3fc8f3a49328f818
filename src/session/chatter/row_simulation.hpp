// SPDX-License-Identifier: MIT
// The vibration of a program: simulated in time, row after row.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "session/chatter/bending_tool.hpp"
#include "session/chatter/surface_recorder.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

// Follows the rows of a program with one BendingTool, at kVibrationHz (simulated_cut.hpp). It starts
// at rest at the first row, after a gap in which everything dies out, and with another cutter. Its frame is
// that of the head (head_frame()). Where the tool moves farther than
// kLargestDisplacement, the modes are held there. One thread.
class RowSimulation {
  public:
    // All arguments must outlive this object. `traces`: run() may be asked for them. `recorder`, if any, gets
    // the displacements.
    explicit RowSimulation(const MillSetup& setup, bool traces = false, SurfaceRecorder* recorder = nullptr);

    // Simulates the samples n / kVibrationHz from the start of the row to its end. Rows come in the order of
    // time. Edges of a flat bottom are left out. Returns the largest displacement, mm; nothing for a row
    // whose teeth follow each other by more than kLongestPitchS.
    // `trace`, if any, gets the difference from the force of a tool that does not bend, sample by sample for
    // at most kLongestTraceS, in the frame of the tool. Where the feed turns, that frame follows in some
    // milliseconds.
    std::optional<double> run(const milling::CutRow& row, std::vector<std::array<float, 2>>* trace = nullptr);
    // Number of the first sample of the last row.
    std::int64_t first_sample() const { return first_; }

    static constexpr double kLongestPitchS = 4, kLongestTraceS = 60;

    // The tool was held in the last row.
    bool was_held() const { return held_; }

  private:
    void start(const milling::CutRow& row);
    void engage(const milling::CutRow& row, std::span<const milling::EngagementBand> bands);
    // Returns the largest displacement, mm.
    double run_to(double end_s, std::vector<std::array<float, 2>>* trace);
    double rpm_now() const;
    std::complex<double> feed_direction(const milling::CutRow& row) const;  // x of the row in frame_

    const MillSetup& setup_;
    std::span<const dynamics::Mode> modes_;  // of the cutter
    double ring_s_ = 0;                      // a vibration dies out in it
    std::vector<int> steps_;                 // per sample, of each cutter at its highest speed
    bool traces_;
    SurfaceRecorder* recorder_;
    std::optional<BendingTool> tool_;
    double rpm_ = 0;            // of the row
    milling::ToolFrame frame_;  // of the vibration
    std::size_t cutter_ = 0;
    std::int64_t first_ = 0, next_ = 0;  // samples
    double last_end_s_ = 0;
    bool held_ = false;
};

}  // namespace tribo::session
