// SPDX-License-Identifier: MIT
// What a tool leaves that bends under the cutting force and does not vibrate: the form error of a job that
// says nothing of modes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dynamics/tool_beam.hpp"
#include "job/job.hpp"
#include "milling/force/force.hpp"
#include "session/chatter/surface_recorder.hpp"

namespace tribo::session {

// The tool is a stepped beam that the spindle clamps (dynamics::ToolBeam), and yields to the force of a stiff
// cut at once. A tooth leaves the displacement of the instant at which it makes the surface. The force acts
// at the mean height of the cut. Joints of holder and spindle, the part and the machine count as stiff, so
// the true error is larger rather than smaller. Floors of flat bottoms are left out. One thread.
class SteadyBending {
  public:
    // The setup must outlive this object.
    explicit SteadyBending(const MillSetup& setup);

    // Rows come in the order of time.
    void add(const milling::CutRow& row);
    // The line of the program from which on nothing is recorded (SurfaceRecorder::kMostMarks).
    std::optional<int> full_at_line() const { return recorder_.full_at_line(); }
    surface::ToothTraces take() { return recorder_.take(); }

  private:
    std::vector<milling::ForceModel> forces_;  // one per cutter
    std::vector<dynamics::ToolBeam> beams_;
    SurfaceRecorder recorder_;
};

// The form error of the job is that of SteadyBending: it has a tolerance and nothing that vibrates.
bool bends_steadily(const job::Job& job);
// What that leaves out, and the remedy.
Warning steady_bending_warning(const std::string& job_file);
// After the run.
Warnings warnings_of(const SteadyBending& bending, const std::string& program_file);

}  // namespace tribo::session
