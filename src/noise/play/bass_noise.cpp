// SPDX-License-Identifier: MIT
#include "noise/play/bass_noise.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace tribo::noise {
namespace {

// 1 / Q of the two sections of a fourth-order Butterworth filter.
constexpr std::array<double, 2> kDamping{1.8477590650225735, 0.7653668647301795};

std::size_t divisor_at(double sample_rate_hz) {
    return static_cast<std::size_t>(std::max(1.0, std::floor(sample_rate_hz / kBassRateHz + 0.5)));
}

ArModel bass_at(const BassModel& bass, double sample_rate_hz) {
    return at_rate(bass.spectrum, sample_rate_hz / static_cast<double>(divisor_at(sample_rate_hz)));
}

}  // namespace

double bass_share(double hz) {
    const double w2 = (hz / kBassHz) * (hz / kBassHz), w4 = w2 * w2;
    return 1 / (1 + w4 * w4);
}

double DetailedNoise::Section::step(double x) {
    const double in = b * x, y = in + s1;
    s1 = s2 - 2 * in - a1 * y;
    s2 = in - a2 * y;
    return y;
}

DetailedNoise::DetailedNoise(const ArModel& model, const BassModel& bass, double sample_rate_hz,
                             std::uint64_t seed)
    : rest_(at_rate(model, sample_rate_hz), seed),
      bass_(bass_at(bass, sample_rate_hz), ~seed),
      divisor_(divisor_at(sample_rate_hz)) {
    // Bilinear transform with the exact corner.
    const double k = math::tan(math::kPi * kBassHz / sample_rate_hz);
    for (std::size_t n = 0; n < high_pass_.size(); ++n) {
        const double a0 = 1 + kDamping[n] * k + k * k;
        high_pass_[n] = {1 / a0, 2 * (k * k - 1) / a0, (1 - kDamping[n] * k + k * k) / a0};
    }
    // Each part gets its own share of the power. The bass of the whole model is not used.
    const ArModel whole = at_rate(model, sample_rate_hz);
    constexpr int kSteps = 4096;
    double power = 0;
    for (int n = 0; n < kSteps; ++n) {
        const double hz = (n + 0.5) / kSteps * 0.5 * sample_rate_hz;
        const double w = math::tan(math::kPi * hz / sample_rate_hz) / k, w4 = w * w * w * w;
        power += power_at(whole, hz) * w4 * w4 / (1 + w4 * w4) / kSteps;
    }
    rest_gain_ = power > 0 ? std::sqrt((1 - bass.share) / power) : 0;
    bass_gain_ = std::sqrt(bass.share);
    // Hann-windowed sinc between the samples of the bass; the sum of each phase is 1.
    taps_.resize(divisor_ * kTaps);
    for (std::size_t phase = 0; phase < divisor_; ++phase) {
        double sum = 0;
        for (std::size_t n = 0; n < kTaps; ++n) {
            const double x = static_cast<double>(n) - kTaps / 2.0 +
                             static_cast<double>(phase) / static_cast<double>(divisor_);
            const double window = 0.5 + 0.5 * math::cos(math::kTwoPi * x / (kTaps + 2));
            const double sinc = x == 0 ? 1 : math::sin(math::kPi * x) / (math::kPi * x);
            sum += taps_[phase * kTaps + n] = window * sinc;
        }
        for (std::size_t n = 0; n < kTaps; ++n) taps_[phase * kTaps + n] /= sum;
    }
    for (double& v : past_) v = next_bass();
}

double DetailedNoise::next_bass() {
    const auto block = bass_.block(bass_at_ / kNoiseBlock);
    return static_cast<double>(block[bass_at_++ % kNoiseBlock]);
}

std::span<const double, kNoiseBlock> DetailedNoise::block(std::uint64_t index) {
    const auto rest = rest_.block(index);
    for (std::size_t n = 0; n < samples_.size(); ++n) {
        if (phase_ == divisor_) {
            std::copy_backward(past_.begin(), past_.end() - 1, past_.end());
            past_[0] = next_bass();
            phase_ = 0;
        }
        const double* taps = &taps_[phase_++ * kTaps];
        double bass[4]{};
        for (std::size_t k = 0; k < kTaps; k += 4) {
            for (std::size_t i = 0; i < 4; ++i) bass[i] += taps[k + i] * past_[k + i];
        }
        const double high = high_pass_[1].step(high_pass_[0].step(static_cast<double>(rest[n])));
        samples_[n] = rest_gain_ * high + bass_gain_ * ((bass[0] + bass[1]) + (bass[2] + bass[3]));
    }
    return samples_;
}

}  // namespace tribo::noise
