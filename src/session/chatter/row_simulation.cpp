// SPDX-License-Identifier: MIT
#include "session/chatter/row_simulation.hpp"

#include <algorithm>
#include <cmath>

#include "session/chatter/row_stability.hpp"
#include "session/chatter/simulated_cut.hpp"

namespace tribo::session {
namespace {

// Rows with a smaller gap are one cut.
constexpr double kSameCutS = 1e-6;
// A frame that turns by more about the axis, from a row to the next, is another one: the axis points down.
constexpr double kSameFrame = 0.995;

std::int64_t sample_at(double t_s) {
    return static_cast<std::int64_t>(std::ceil(t_s * kVibrationHz - kSameCutS));
}

}  // namespace

RowSimulation::RowSimulation(const MillSetup& setup, bool traces, SurfaceRecorder* recorder)
    : setup_(setup), traces_(traces), recorder_(recorder) {
    for (const auto& modes : setup.modes_of_cutter) ring_s_ = std::max(ring_s_, ring_s(modes));
    steps_.assign(setup.cutters.size(), 1);
    const double fastest = 1 + setup.variation.share;
    for (std::size_t n = 0; n < setup.moves.size(); ++n) {
        const std::size_t cutter = setup.cutter_of_move[n];
        steps_[cutter] = std::max(steps_[cutter], steps_per_sample(setup.modes(cutter), setup.cutters[cutter],
                                                                   fastest * setup.rpm_of_move[n]));
    }
}

std::optional<double> RowSimulation::run(const milling::CutRow& row,
                                         std::vector<std::array<float, 2>>* trace) {
    held_ = false;
    const milling::Cutter& cutter = setup_.cutters[row.cutter];
    const double longest_pitch_deg =
        cutter.pitch_deg.empty() ? 360.0 / cutter.flutes : std::ranges::max(cutter.pitch_deg);
    const bool slow = longest_pitch_deg / 360 * 60 > kLongestPitchS * row.spindle_rpm;
    if (slow) {
        tool_.reset();
        return std::nullopt;
    }
    const milling::ToolFrame frame = head_frame(row, setup_);
    const bool goes_on = tool_ && row.cutter == cutter_ && row.start_s <= last_end_s_ + ring_s_ &&
                         dot(frame.x, frame_.x) > kSameFrame;
    if (!goes_on) {
        start(row);
    } else if (row.start_s > last_end_s_ + kSameCutS) {
        engage(row, {});
        run_to(row.start_s, nullptr);
    }
    frame_ = frame;
    const std::vector<milling::EngagementBand> bands = with_fewer_bands(row.engagement.bands, kRowBands);
    engage(row, bands);
    if (recorder_ != nullptr)
        recorder_->begin(row, bands, frame_, tool_->rotation_rad(),
                         static_cast<double>(next_) / kVibrationHz);
    last_end_s_ = row.end_s;
    first_ = next_;
    const double largest = run_to(row.end_s, trace);
    if (recorder_ != nullptr) recorder_->end();
    return largest;
}

void RowSimulation::start(const milling::CutRow& row) {
    if (recorder_ != nullptr) recorder_->interrupt();
    cutter_ = row.cutter;
    modes_ = setup_.modes(cutter_);
    next_ = sample_at(row.start_s);
    const double first_s = static_cast<double>(next_) / kVibrationHz;
    frame_ = head_frame(row, setup_);
    const std::complex<double> feed = feed_direction(row);
    // The force of a row counts the rotation from its feed (milling/force/row_force.hpp).
    const double rotation_rad = row.phase_at_rad(first_s) - math::atan2(feed.imag(), feed.real());
    tool_.emplace(modes_in(frame_, frame_, modes_), setup_.cutters[cutter_], setup_.coefficients,
                  kVibrationHz, steps_[cutter_], rotation_rad, feed, traces_);
}

std::complex<double> RowSimulation::feed_direction(const milling::CutRow& row) const {
    return {dot(row.pose.frame.x, frame_.x), dot(row.pose.frame.x, frame_.y)};
}

void RowSimulation::engage(const milling::CutRow& row, std::span<const milling::EngagementBand> bands) {
    rpm_ = row.spindle_rpm;
    tool_->engage(modes_in(frame_, frame_, modes_), bands, row.feed, rpm_now(), feed_direction(row));
}

double RowSimulation::rpm_now() const {
    return setup_.variation.rpm_at(rpm_, static_cast<double>(next_) / kVibrationHz);
}

double RowSimulation::run_to(double end_s, std::vector<std::array<float, 2>>* trace) {
    tool_->reset_largest();
    for (const std::int64_t end = sample_at(end_s); next_ < end; ++next_) {
        if (setup_.variation.is_there() && next_ % kVariationSamples == 0) tool_->turn_at(rpm_now());
        tool_->next();
        if (recorder_ != nullptr) recorder_->add(tool_->displaced_at_rad(), tool_->displaced_mm());
        if (trace != nullptr && static_cast<double>(trace->size()) < kLongestTraceS * kVibrationHz)
            trace->push_back(tool_->added_n());
    }
    held_ = held_ || tool_->was_held();
    return tool_->largest_mm();
}

}  // namespace tribo::session
