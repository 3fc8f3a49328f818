// SPDX-License-Identifier: MIT
#include "session/chatter/bending_tool.hpp"

#include <algorithm>

#include "session/chatter/simulated_cut.hpp"

namespace tribo::session {
namespace {

// Of what is left of a turn of the feed, in a sample: it takes 4 ms.
constexpr double kFollow = 0.01;
// Smaller vibrations, of what they were, have died out.
constexpr double kDiedOut = 1e-4;

}  // namespace

double ring_s(std::span<const dynamics::Mode> modes) {
    double longest = 0;
    for (const dynamics::Mode& mode : modes)
        longest =
            std::max(longest, -math::log(kDiedOut) / (mode.damping_ratio * math::kTwoPi * mode.frequency_hz));
    return longest;
}

BendingTool::BendingTool(std::span<const dynamics::Mode> modes, const milling::Cutter& cutter,
                         const milling::CuttingCoefficients& coefficients, double rate_hz, int steps,
                         double rotation_rad, std::complex<double> feed, bool compared)
    : vibration_(modes, cutter, coefficients, steps * rate_hz, rotation_rad),
      steps_(steps),
      most_mm_(kLargestDisplacement * cutter.diameter_mm),
      feed_now_(feed) {
    if (compared)
        rigid_.emplace(std::span<const dynamics::Mode>{}, cutter, coefficients, steps * rate_hz,
                       rotation_rad);
    feed_.fill(feed);
}

void BendingTool::engage(std::span<const dynamics::Mode> modes,
                         std::span<const milling::EngagementBand> bands, const milling::ToolTravel& per_tooth,
                         double spindle_rpm, std::complex<double> feed) {
    const double feed_rad = math::atan2(feed.imag(), feed.real());
    vibration_.turn_modes(modes);
    vibration_.engage(bands, per_tooth, spindle_rpm, feed_rad);
    if (rigid_) rigid_->engage(bands, per_tooth, spindle_rpm, feed_rad);
    feed_now_ = feed;
}

void BendingTool::turn_at(double spindle_rpm) {
    vibration_.turn_at(spindle_rpm);
    if (rigid_) rigid_->turn_at(spindle_rpm);
}

void BendingTool::next() {
    Vec3 added{};
    for (int step = 0; step < steps_; ++step) {
        displaced_at_rad_ = vibration_.rotation_rad();
        const dynamics::VibrationSample sample = vibration_.step();
        displaced_mm_ = sample.displacement_mm;
        if (rigid_) added += sample.force_n - rigid_->step().force_n;
        displacement_mm_ = length(sample.displacement_mm);
        if (displacement_mm_ > most_mm_) {
            vibration_.scale_modes(most_mm_ / displacement_mm_);
            displacement_mm_ = most_mm_;
            held_ = true;
        }
        largest_mm_ = std::max(largest_mm_, displacement_mm_);
    }
    if (!rigid_) return;
    added_n_ = added / steps_;
    feed_[0] += kFollow * (feed_now_ - feed_[0]);
    feed_[1] += kFollow * (feed_[0] - feed_[1]);
}

std::array<float, 2> BendingTool::added_n() const {
    const double size = std::abs(feed_[1]);
    const std::complex<double> across =
        std::complex<double>(added_n_.x, added_n_.y) * std::conj(size > 0 ? feed_[1] / size : feed_now_);
    return {static_cast<float>(across.real()), static_cast<float>(across.imag())};
}

void BendingTool::reset_largest() {
    largest_mm_ = displacement_mm_;
    held_ = false;
}

}  // namespace tribo::session
