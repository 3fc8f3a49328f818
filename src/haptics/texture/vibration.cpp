// SPDX-License-Identifier: MIT
#include "haptics/texture/vibration.hpp"

#include <algorithm>

namespace tribo::haptics {

BandVibration::BandVibration(double rate_hz, const Options& options)
    : options_(options), noise_(options.seed, rate_hz, options.band) {}

double BandVibration::next(double speed_mm_per_s, double press_n) noexcept {
    double sample = 0;
    noise_.render(tick_++, {&sample, 1});
    const double rise = std::clamp(speed_mm_per_s / options_.full_speed_mm_per_s, 0.0, 1.0);
    return options_.share * std::max(press_n, 0.0) * rise * sample;
}

LearnedVibration::LearnedVibration(const noise::MaterialVoices& voices, double rate_hz,
                                   double newton_per_full_scale, std::uint64_t seed)
    : voice_(voices, {.sample_rate_hz = rate_hz, .seed = seed}), scale_(newton_per_full_scale) {}

double LearnedVibration::next(double speed_mm_per_s, double press_n) noexcept {
    voice_.set_target(speed_mm_per_s, press_n);
    float sample = 0;
    voice_.render({&sample, 1});
    return scale_ * static_cast<double>(sample);
}

}  // namespace tribo::haptics
