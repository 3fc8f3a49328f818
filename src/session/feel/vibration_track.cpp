// SPDX-License-Identifier: MIT
#include "session/feel/vibration_track.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace tribo::session {
namespace {

// Border of the band, of the rate; half width of the kernel, samples of the servo; steps of its table.
constexpr double kBorder = 0.325, kHalfWidth = 12, kSteps = 256;

}  // namespace

// A windowed sinc (Hann): its step from full to nothing is as wide as 2 / kHalfWidth of the rate.
VibrationTrack::VibrationTrack(double rate_hz, double duration_s)
    : rate_hz_(rate_hz), force_n_(static_cast<std::size_t>(std::ceil(duration_s * rate_hz)) + 1) {
    const int steps = static_cast<int>(kHalfWidth * kSteps);
    for (int n = 0; n <= steps; ++n) {
        const double x = n / kSteps, phase = math::kTwoPi * kBorder * x;
        const double sinc = n == 0 ? 1 : math::sin(phase) / phase;
        kernel_.push_back(2 * kBorder * sinc * (0.5 + 0.5 * math::cos(math::kPi * x / kHalfWidth)));
    }
}

double VibrationTrack::weight(double from_centre) const {
    const double at = std::abs(from_centre) * kSteps;
    const auto n = static_cast<std::size_t>(at);
    return n + 1 < kernel_.size() ? std::lerp(kernel_[n], kernel_[n + 1], at - static_cast<double>(n)) : 0;
}

void VibrationTrack::add(const contact::ForceTrace& trace, const milling::ToolFrame& frame) {
    const double per_sample = rate_hz_ / trace.rate_hz;
    const auto last = static_cast<double>(force_n_.size() - 1);
    for (std::size_t n = 0; n < trace.force_n.size(); ++n) {
        const double centre = static_cast<double>(trace.first + static_cast<std::int64_t>(n)) * per_sample;
        const Vec3 force = frame.in_stock({double{trace.force_n[n][0]}, double{trace.force_n[n][1]}, 0});
        const double from = std::max(std::ceil(centre - kHalfWidth), 0.0);
        const double to = std::min(std::floor(centre + kHalfWidth), last);
        for (double k = from; k <= to; ++k) {
            const double share = per_sample * weight(k - centre);
            Sample& sum = force_n_[static_cast<std::size_t>(k)];
            for (int i = 0; i < 3; ++i)
                sum[static_cast<std::size_t>(i)] += static_cast<float>(share * force[i]);
        }
    }
}

Vec3 VibrationTrack::force_n(double at_s) const noexcept {
    const double at = at_s * rate_hz_;
    if (!(at >= 0) || !(at < static_cast<double>(force_n_.size() - 1))) return {};
    const auto n = static_cast<std::size_t>(at);
    const auto vec = [](const Sample& f) { return Vec3{double{f[0]}, double{f[1]}, double{f[2]}}; };
    return lerp(vec(force_n_[n]), vec(force_n_[n + 1]), at - static_cast<double>(n));
}

}  // namespace tribo::session
