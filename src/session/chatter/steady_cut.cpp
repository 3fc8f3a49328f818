// SPDX-License-Identifier: MIT
#include "session/chatter/steady_cut.hpp"

#include <algorithm>
#include <cmath>

#include "milling/tool/tool_frame.hpp"
#include "motion/algebra/direction.hpp"
#include "motion/path/path.hpp"
#include "session/cut/cutter_modes.hpp"
#include "session/cut/mill_setup.hpp"

namespace tribo::session {
namespace {

Vec3 in_frame(const milling::ToolFrame& frame, Vec3 v) {
    return {dot(frame.x, v), dot(frame.y, v), dot(frame.z, v)};
}

// The first feed move that goes across the tool axis by more than along it.
std::size_t first_cut(const std::vector<motion::Move>& moves) {
    for (std::size_t n = 0; n < moves.size(); ++n) {
        const motion::Move& move = moves[n];
        if (move.kind != motion::MoveKind::feed) continue;
        const Vec3 way = motion::pose_at(move, 0.01).tip_mm - move.start.tip_mm;
        const double along = dot(way, move.start.axis);
        if (length(way - along * move.start.axis) > std::abs(along)) return n;
    }
    return moves.size();
}

}  // namespace

milling::ToolFrame head_frame(const motion::ToolPose& pose) {
    const auto turned = [&](Vec3 v) {
        return motion::turned(motion::turned_upright(v, pose.axis), pose.axis, pose.turn_rad);
    };
    return {turned({1, 0, 0}), turned({0, 1, 0}), pose.axis};
}

milling::ToolFrame head_frame(const milling::CutRow& row, const MillSetup& setup) {
    motion::ToolPose pose{row.pose.tip_mm, row.pose.frame.z};
    if (setup.on_machine) {
        const double middle_s = 0.5 * (row.start_s + row.end_s);
        pose.turn_rad = motion::pose_at_time(setup.moves, *setup.schedule, middle_s).turn_rad;
    }
    return head_frame(pose);
}

std::vector<dynamics::Mode> modes_in(const milling::ToolFrame& frame, const milling::ToolFrame& head,
                                     std::span<const dynamics::Mode> modes) {
    std::vector<dynamics::Mode> turned(modes.begin(), modes.end());
    for (dynamics::Mode& mode : turned) {
        if (mode.on == dynamics::ModeOn::tool) mode.direction = head.in_stock(mode.direction);
        mode.direction = in_frame(frame, mode.direction);
    }
    return turned;
}

Result<void> check_modes(const job::Job& job) {
    if (job.can_vibrate()) return {};
    return fail_at(
        job.file, 0, 0, "the job has no [[mode]] and no [[frf]]: nothing in it can vibrate",
        "write one for each mode of tool or part, with direction, frequency_hz, damping_ratio and "
        "stiffness_n_per_mm; or name a measured response as file in [[frf]]; or stickout_mm of the "
        "cutter, and [dynamics] with estimate = true");
}

Result<SteadyCut> steady_cut(const job::Job& job, const motion::Program& program, Warnings& warnings) {
    if (auto good = check_modes(job); !good) return std::unexpected(good.error());
    auto setup = prepare_moves(job, program, {}, warnings);
    if (!setup) return std::unexpected(setup.error());
    if (auto done = add_modes(job, *setup, warnings); !done) return std::unexpected(done.error());
    const std::size_t n = first_cut(setup->moves);
    if (n == setup->moves.size()) {
        return fail_at(program.source, 0, 0, "no feed move goes across the tool axis",
                       "give the path one along the feed direction of the cut");
    }
    const motion::Move& move = setup->moves[n];
    SteadyCut cut;
    cut.cutter = setup->cutters[setup->cutter_of_move[n]];
    cut.coefficients = setup->coefficients;
    cut.force_low_factor = setup->force_low_factor;
    cut.force_high_factor = setup->force_high_factor;
    cut.spindle_rpm = setup->rpm_of_move[n];
    cut.feed_per_tooth_mm = move.feed_mm_per_min / (cut.spindle_rpm * cut.cutter.flutes);
    cut.variation = setup->variation;
    cut.line = move.line;
    const PrescribedEngagement& engagement = *setup->engagement;
    cut.axial_depth_mm = engagement.axial_depth_mm;
    cut.bands = {{0, engagement.axial_depth_mm, engagement.entry_rad, engagement.exit_rad}};
    const Vec3 way = motion::pose_at(move, 0.01).tip_mm - move.start.tip_mm;
    cut.modes = modes_in(milling::tool_frame(move.start.axis, way, {1, 0, 0}), head_frame(move.start),
                         setup->modes(setup->cutter_of_move[n]));
    return cut;
}

std::vector<milling::EngagementBand> SteadyCut::bands_at(double depth_mm) const {
    double low = bands[0].z0_mm, high = bands[0].z1_mm;
    for (const milling::EngagementBand& band : bands) {
        low = std::min(low, band.z0_mm);
        high = std::max(high, band.z1_mm);
    }
    const double top = low + depth_mm;
    std::vector<milling::EngagementBand> cut;
    for (milling::EngagementBand band : bands) {
        if (band.z1_mm == high || band.z1_mm > top) band.z1_mm = top;
        if (band.z1_mm > band.z0_mm) cut.push_back(band);
    }
    return cut;
}

double SteadyCut::entry_rad() const {
    return milling::hull({bands, {}}).entry_rad;
}

double SteadyCut::exit_rad() const {
    return milling::hull({bands, {}}).exit_rad;
}

dynamics::Stability SteadyCut::at(double rpm, double depth_mm) const {
    return dynamics::stability(modes, dynamics::CutFeedback(cutter, coefficients, bands_at(depth_mm), rpm));
}

dynamics::DepthLimit SteadyCut::limit(double rpm) const {
    return dynamics::depth_limit([&](double depth_mm) { return at(rpm, depth_mm); }, cutter.length_mm);
}

double SteadyCut::least_rpm(double depth_mm) const {
    const dynamics::CutFeedback cut(cutter, coefficients, bands_at(depth_mm), spindle_rpm);
    return spindle_rpm * dynamics::phase_rad(modes, cut) / dynamics::kMostPhaseRad;
}

}  // namespace tribo::session
