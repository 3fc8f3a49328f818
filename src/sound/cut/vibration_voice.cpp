// SPDX-License-Identifier: MIT
#include "sound/cut/vibration_voice.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "sound/cut/smoothstep.hpp"
#include "sound/play/calibration.hpp"

namespace tribo::sound {
namespace {

// Less than what is always known ahead of what is heard: the delay less half a quantum at 32 kHz.
constexpr double kFadeSeconds = 0.003;
// A gap between traces up to this is filled: what comes before it may not have been heard yet.
constexpr std::int64_t kGap = 1024;

}  // namespace

std::complex<double> vibration_response(double hz, double rate_hz) {
    double sine, cosine;
    math::sincos(math::kTwoPi * hz * kVibrationDelayS, sine, cosine);
    return InPlane::response(hz, rate_hz) * std::complex<double>(cosine, -sine);
}

VibrationVoice::VibrationVoice(const VibrationVoiceOptions& options) : options_(options) {
    body_.set(options.body, options.sample_rate_hz);
}

void VibrationVoice::excite(const contact::ContactSample& next, std::int64_t) {
    if (next.vibration != nullptr && !next.vibration->force_n.empty()) keep(*next.vibration);
}

void VibrationVoice::keep(const contact::ForceTrace& trace) {
    const bool follows =
        first_ < end_ && trace.rate_hz == rate_hz_ && trace.first >= end_ && trace.first <= end_ + kGap;
    if (!follows) {
        in_plane_.forget();
        rate_hz_ = trace.rate_hz;
        first_ = begin_ = end_ = trace.first;
    }
    while (end_ < trace.first) {
        for (double& force : last_n_) force *= 1 - 1 / (kFadeSeconds * rate_hz_);
        append(last_n_);
    }
    for (const auto& [x, y] : trace.force_n) {
        const double share = smoothstep(static_cast<double>(end_ - begin_) / (kFadeSeconds * rate_hz_));
        last_n_ = {share * static_cast<double>(x), share * static_cast<double>(y)};
        append(last_n_);
    }
    first_ = std::max(first_, end_ - static_cast<std::int64_t>(kKept));
}

void VibrationVoice::append(const std::array<double, 2>& force_n) {
    value(end_++) = kPascalPerNewton * in_plane_.next(force_n[0], force_n[1]);
}

double VibrationVoice::heard_index() const {
    return (static_cast<double>(frame_) / options_.sample_rate_hz - kVibrationDelayS) * rate_hz_;
}

void VibrationVoice::release() {
    const auto fades = static_cast<std::int64_t>(heard_index() + kFadeSeconds * rate_hz_);
    end_ = std::clamp(fades, first_, end_);
}

double VibrationVoice::value_at(double index) {
    const auto before = static_cast<std::int64_t>(std::floor(index));
    const double t = index - static_cast<double>(before);
    if (before < first_ || before >= end_) return 0;
    const double share = smoothstep((static_cast<double>(end_) - index) / (kFadeSeconds * rate_hz_));
    if (t == 0) return share * value(before);
    // By a cubic through the four values around it.
    const auto near = [&](std::int64_t n) { return value(std::clamp(n, first_, end_ - 1)); };
    const double a = near(before - 1), b = near(before), c = near(before + 1), d = near(before + 2);
    return share * (b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a))));
}

void VibrationVoice::add(Quantum& pressure_pa) {
    const double from = heard_index(), per_frame = rate_hz_ / options_.sample_rate_hz;
    frame_ += kQuantumFrames;
    Quantum sound{};
    if (first_ < end_ && from < static_cast<double>(end_)) {
        for (std::size_t j = 0; j < sound.size(); ++j)
            sound[j] = value_at(from + static_cast<double>(j) * per_frame);
        ringing_ = body_.ring_quanta();
    }
    if (ringing_ == 0) return;
    body_.apply(sound);
    for (std::size_t j = 0; j < sound.size(); ++j) pressure_pa[j] += options_.share * sound[j];
    if (--ringing_ == 0) body_.forget();
}

}  // namespace tribo::sound
