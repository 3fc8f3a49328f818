// SPDX-License-Identifier: MIT
#include "session/touch/rubbing.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tribo::session {
namespace {

constexpr double kTailS = 0.05;
// Interval between updates of the targets, independent of the block size.
constexpr std::size_t kStepFrames = 32;

}  // namespace

StrokeMotion::StrokeMotion(std::span<const readers::FingerPoint> points) : points_(points) {
    assert(points.size() >= 2);
}

double StrokeMotion::speed_of(std::size_t segment) const {
    const readers::FingerPoint &a = points_[segment], &b = points_[segment + 1];
    const double dx = b.x_mm - a.x_mm, dy = b.y_mm - a.y_mm;
    return std::sqrt(dx * dx + dy * dy) / (b.t_s - a.t_s);
}

double StrokeMotion::change_s(std::size_t point) const {
    if (point == 0 || point + 1 >= points_.size()) return 0;
    // The motion of a lifted finger between two strokes has no effect on either.
    const auto lifted = [&](std::size_t n) { return points_[n].force_n <= 0 && points_[n + 1].force_n <= 0; };
    if (lifted(point - 1) || lifted(point)) return 0;
    const double before = points_[point].t_s - points_[point - 1].t_s;
    const double after = points_[point + 1].t_s - points_[point].t_s;
    return std::min(kSpeedChangeS, 0.5 * std::min(before, after));
}

StrokeMotion::State StrokeMotion::at(double t_s) {
    if (t_s < points_.front().t_s || t_s > points_.back().t_s) return {};
    while (segment_ + 2 < points_.size() && t_s >= points_[segment_ + 1].t_s) ++segment_;
    const readers::FingerPoint &a = points_[segment_], &b = points_[segment_ + 1];
    const double share = (t_s - a.t_s) / (b.t_s - a.t_s);
    State state{speed_of(segment_), std::max(0.0, a.force_n + share * (b.force_n - a.force_n))};
    const double since = t_s - a.t_s, until = b.t_s - t_s;
    if (const double h = change_s(segment_); since < h) {
        const double other = speed_of(segment_ - 1);
        state.speed_mm_per_s =
            0.5 * (other + state.speed_mm_per_s) + 0.5 * (state.speed_mm_per_s - other) * since / h;
    } else if (const double g = change_s(segment_ + 1); until < g) {
        const double other = speed_of(segment_ + 1);
        state.speed_mm_per_s =
            0.5 * (other + state.speed_mm_per_s) + 0.5 * (state.speed_mm_per_s - other) * until / g;
    }
    return state;
}

Rubbing::Rubbing(const noise::MaterialVoices& voices, std::span<const readers::FingerPoint> points,
                 const noise::FrictionOptions& options)
    : sample_rate_hz_(options.sample_rate_hz),
      motion_(points),
      voice_(voices, options),
      frames_(static_cast<std::int64_t>(std::ceil((points.back().t_s + kTailS) * options.sample_rate_hz))) {}

void Rubbing::render(std::span<float> out) {
    while (!out.empty()) {
        const std::uint64_t frame = voice_.frame();
        if (frame % kStepFrames == 0) {
            const StrokeMotion::State state = motion_.at(static_cast<double>(frame) / sample_rate_hz_);
            voice_.set_target(state.speed_mm_per_s, state.force_n);
        }
        const std::size_t count =
            std::min(out.size(), kStepFrames - static_cast<std::size_t>(frame % kStepFrames));
        voice_.render(out.first(count));
        out = out.subspan(count);
    }
}

}  // namespace tribo::session
