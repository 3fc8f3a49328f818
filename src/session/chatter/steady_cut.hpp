// SPDX-License-Identifier: MIT
// The steady cut of a job, about which is asked whether it chatters.
#pragma once

#include <vector>

#include "dynamics/stability.hpp"
#include "job/job.hpp"
#include "motion/path/program.hpp"

namespace tribo::session {

struct SteadyCut {
    milling::Cutter cutter;
    milling::CuttingCoefficients coefficients;
    std::vector<dynamics::Mode> modes;  // directions in the frame of the feed: x along it, z to the shank
    double entry_rad = 0, exit_rad = 0;
    double axial_depth_mm = 0, spindle_rpm = 0;  // as the job has them
    int line = 0;                                // of the move in the program

    // Of the same cut at another speed and depth.
    dynamics::Stability at(double spindle_rpm, double axial_depth_mm) const;
    // The least depth at which it is no longer stable, from 0 to the length of the cutting edges.
    dynamics::DepthLimit limit(double spindle_rpm) const;
    // Slower ones take too long (dynamics::kMostPhaseRad): the modes vibrate too often in a period.
    double least_rpm(double axial_depth_mm) const;
};

// Takes the engagement of [engagement], and tool, speed and feed direction of the first feed move across the
// tool axis. Refuses a job without modes, without [engagement] or without such a move, and a tool axis that a
// machine tilts: its head would have to be told from its table.
Result<SteadyCut> steady_cut(const job::Job& job, const motion::Program& program, Warnings& warnings);

}  // namespace tribo::session
