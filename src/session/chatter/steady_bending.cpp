// SPDX-License-Identifier: MIT
#include "session/chatter/steady_bending.hpp"

#include "milling/engagement/load_height.hpp"

namespace tribo::session {

namespace {

// Edges that enter or leave at once bend a tool of any mass only after that instant.
constexpr double kBeforeRad = 1e-6;

}  // namespace

SteadyBending::SteadyBending(const MillSetup& setup) : recorder_(setup) {
    for (const milling::Cutter& cutter : setup.cutters) {
        forces_.emplace_back(cutter, setup.coefficients);
        beams_.push_back(dynamics::tool_beam(cutter));
    }
}

void SteadyBending::add(const milling::CutRow& row) {
    milling::ForceModel& force = forces_[row.cutter];
    force.engage(row.engagement, row.feed);
    const dynamics::ToolBeam& beam = beams_[row.cutter];
    const double force_height_mm = milling::load_height_mm(row.engagement);
    recorder_.add_steady(row, force.edges().period_rad(), [&](double rotation_rad, double height_mm) {
        const Vec3 force_n = force.at(rotation_rad - kBeforeRad).force_n;
        const double yield = dynamics::yield_mm_per_n(beam, force_height_mm, height_mm);
        return yield * Vec3{force_n.x, force_n.y, 0};
    });
}

bool bends_steadily(const job::Job& job) {
    return job.limits.tolerance_mm && !job.can_vibrate();
}

Warnings warnings_of(const SteadyBending& bending, const std::string& program_file) {
    const std::optional<int> line = bending.full_at_line();
    return line ? Warnings{SurfaceRecorder::full_warning(program_file, *line)} : Warnings{};
}

Warning steady_bending_warning(const std::string& job_file) {
    return {
        job_file, 0,
        "the form error is that of a tool which bends as a beam and does not vibrate; holder joints, spindle "
        "and part count as stiff; write [[mode]], or [dynamics] estimate = true with stickout_mm"};
}

}  // namespace tribo::session
