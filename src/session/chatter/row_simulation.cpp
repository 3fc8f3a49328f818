// SPDX-License-Identifier: MIT
#include "session/chatter/row_simulation.hpp"

#include <algorithm>
#include <cmath>

#include "session/chatter/row_stability.hpp"
#include "session/chatter/simulated_cut.hpp"

namespace tribo::session {
namespace {

// Smaller vibrations, of what they were, have died out.
constexpr double kDiedOut = 1e-4;
// Rows with a smaller gap are one cut.
constexpr double kSameCutS = 1e-6;
// Of what is left of a turn of the feed, in a sample: it takes 4 ms.
constexpr double kFollow = 0.01;
// A frame that turns by more about the axis, from a row to the next, is another one: the axis points down.
constexpr double kSameFrame = 0.995;

std::int64_t sample_at(double t_s) {
    return static_cast<std::int64_t>(std::ceil(t_s * kVibrationHz - kSameCutS));
}

}  // namespace

RowSimulation::RowSimulation(const MillSetup& setup, std::span<const dynamics::Mode> modes, bool traces)
    : setup_(setup), modes_(modes), traces_(traces) {
    for (const dynamics::Mode& mode : modes)
        ring_s_ =
            std::max(ring_s_, -math::log(kDiedOut) / (mode.damping_ratio * math::kTwoPi * mode.frequency_hz));
    steps_.assign(setup.cutters.size(), 1);
    for (std::size_t n = 0; n < setup.moves.size(); ++n) {
        const std::size_t cutter = setup.cutter_of_move[n];
        steps_[cutter] =
            std::max(steps_[cutter], steps_per_sample(modes, setup.cutters[cutter], setup.rpm_of_move[n]));
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
        vibration_.reset();
        return std::nullopt;
    }
    const milling::ToolFrame frame = head_frame(row, setup_);
    const bool goes_on = vibration_ && row.cutter == cutter_ && row.start_s <= last_end_s_ + ring_s_ &&
                         dot(frame.x, frame_.x) > kSameFrame;
    if (!goes_on) {
        start(row);
    } else if (row.start_s > last_end_s_ + kSameCutS) {
        engage(row, {});
        run_to(row.start_s, nullptr);
    }
    frame_ = frame;
    engage(row, with_fewer_bands(row.engagement.bands, kRowBands));
    last_end_s_ = row.end_s;
    first_ = next_;
    return run_to(row.end_s, trace);
}

void RowSimulation::start(const milling::CutRow& row) {
    cutter_ = row.cutter;
    next_ = sample_at(row.start_s);
    displacement_mm_ = 0;
    const double first_s = static_cast<double>(next_) / kVibrationHz;
    frame_ = head_frame(row, setup_);
    // The force of a row counts the rotation from its feed (milling/force/row_force.hpp).
    const double rotation_rad = row.phase_at_rad(first_s) - feed_rad(row);
    const double rate_hz = steps_[cutter_] * kVibrationHz;
    vibration_.emplace(modes_in(frame_, frame_, modes_), setup_.cutters[cutter_], setup_.coefficients,
                       rate_hz, rotation_rad);
    if (traces_)
        rigid_.emplace(std::span<const dynamics::Mode>{}, setup_.cutters[cutter_], setup_.coefficients,
                       rate_hz, rotation_rad);
    feed_.fill(feed_direction(row));
}

std::complex<double> RowSimulation::feed_direction(const milling::CutRow& row) const {
    return {dot(row.pose.frame.x, frame_.x), dot(row.pose.frame.x, frame_.y)};
}

double RowSimulation::feed_rad(const milling::CutRow& row) const {
    return math::atan2(dot(row.pose.frame.x, frame_.y), dot(row.pose.frame.x, frame_.x));
}

void RowSimulation::engage(const milling::CutRow& row, std::span<const milling::EngagementBand> bands) {
    vibration_->turn_modes(modes_in(frame_, frame_, modes_));
    vibration_->engage(bands, row.feed, row.spindle_rpm, feed_rad(row));
    if (traces_) rigid_->engage(bands, row.feed, row.spindle_rpm, feed_rad(row));
    feed_now_ = feed_direction(row);
}

double RowSimulation::run_to(double end_s, std::vector<std::array<float, 2>>* trace) {
    const double most_mm = kLargestDisplacement * setup_.cutters[cutter_].diameter_mm;
    double largest = displacement_mm_;
    for (const std::int64_t end = sample_at(end_s); next_ < end; ++next_) {
        Vec3 force_n{};
        for (int step = 0; step < steps_[cutter_]; ++step) {
            const dynamics::VibrationSample sample = vibration_->step();
            if (traces_) force_n += sample.force_n - rigid_->step().force_n;
            displacement_mm_ = length(sample.displacement_mm);
            if (displacement_mm_ > most_mm) {
                vibration_->scale_modes(most_mm / displacement_mm_);
                displacement_mm_ = most_mm;
                held_ = true;
            }
            largest = std::max(largest, displacement_mm_);
        }
        feed_[0] += kFollow * (feed_now_ - feed_[0]);
        feed_[1] += kFollow * (feed_[0] - feed_[1]);
        if (trace == nullptr || static_cast<double>(trace->size()) >= kLongestTraceS * kVibrationHz) continue;
        const double size = std::abs(feed_[1]);
        const std::complex<double> across = std::complex<double>(force_n.x, force_n.y) *
                                            std::conj(size > 0 ? feed_[1] / size : feed_now_) /
                                            static_cast<double>(steps_[cutter_]);
        trace->push_back({static_cast<float>(across.real()), static_cast<float>(across.imag())});
    }
    return largest;
}

}  // namespace tribo::session
