// SPDX-License-Identifier: MIT
// The steady cut of a job, about which is asked whether it chatters.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dynamics/stability.hpp"
#include "job/job.hpp"
#include "milling/tool/tool_frame.hpp"
#include "motion/path/program.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {

struct SteadyCut {
    milling::Cutter cutter;
    milling::CuttingCoefficients coefficients;
    // Factors on a force: the band in which the true one lies.
    double force_low_factor = 1, force_high_factor = 1;
    std::vector<dynamics::Mode> modes;  // directions in the frame of the feed: x along it, z to the shank
    std::vector<milling::EngagementBand> bands;  // at the job's depth, sorted by z0; never empty
    double axial_depth_mm = 0, spindle_rpm = 0, feed_per_tooth_mm = 0;  // as the job has them
    SpindleVariation variation;                                         // the vibration in time follows it
    int line = 0;                                                       // of the move in the program
    std::optional<double> t_s;  // of the row in the program; absent: [engagement]
    std::size_t rows = 0;       // of which this one is the most critical; 0: [engagement]

    // The bands at another depth: cut off from above, or with the highest ones going on.
    std::vector<milling::EngagementBand> bands_at(double axial_depth_mm) const;
    // The hull of all bands.
    double entry_rad() const;
    double exit_rad() const;

    // Of the same cut at another speed and depth.
    dynamics::Stability at(double spindle_rpm, double axial_depth_mm) const;
    // The least depth at which it is no longer stable, from 0 to the length of the cutting edges.
    dynamics::DepthLimit limit(double spindle_rpm) const;
    // Slower ones take too long (dynamics::kMostPhaseRad): the modes vibrate too often in a period.
    double least_rpm(double axial_depth_mm) const;
};

// The axes of the head as they stand in the stock: at rotary zero those of the machine. Without a machine
// they are those of the stock, turned by the shortest rotation of +z to the tool axis.
milling::ToolFrame head_frame(const motion::ToolPose& pose);
// The same in the middle of a row, whose setup this is.
milling::ToolFrame head_frame(const milling::CutRow& row, const MillSetup& setup);

// The modes of a job in a frame. Those of the tool stand in the axes of the head, those of the part in the
// axes of the stock.
std::vector<dynamics::Mode> modes_in(const milling::ToolFrame& frame, const milling::ToolFrame& head,
                                     std::span<const dynamics::Mode> modes);

// Refuses a job without modes.
Result<void> check_modes(const job::Job& job);

// Takes the engagement of [engagement], which the job must have, and tool, speed and feed direction of the
// first feed move across the tool axis. Refuses a job without such a move.
Result<SteadyCut> steady_cut(const job::Job& job, const motion::Program& program, Warnings& warnings);

}  // namespace tribo::session
