// SPDX-License-Identifier: MIT
#include "noise/play/band_noise.hpp"

#include <cassert>
#include <cmath>

#include "base/math.hpp"

namespace tribo::noise {
namespace {

constexpr double kSqrt2 = 1.4142135623730951;

// The impulse response is summed until this many time constants of its slower pole pair are over: what is
// left of the energy is under e^-60.
constexpr double kTimeConstants = 30;

}  // namespace

double BandNoise::Section::step(double x) {
    const double y = x + s1;
    s1 = b1 * x - a1 * y + s2;
    s2 = x - a2 * y;
    return y;
}

BandNoise::Section BandNoise::section(double k, double b1) {
    const double a0 = 1 + kSqrt2 * k + k * k;
    return {b1, 2 * (k * k - 1) / a0, (1 - kSqrt2 * k + k * k) / a0};
}

BandNoise::BandNoise(std::uint64_t seed, double sample_rate_hz, Band band) : white_(seed) {
    assert(0 < band.low_hz && band.low_hz < band.high_hz && band.high_hz < 0.5 * sample_rate_hz);
    sections_ = {section(math::tan(math::kPi * band.low_hz / sample_rate_hz), -2),
                 section(math::tan(math::kPi * band.high_hz / sample_rate_hz), 2)};
    // Unit white noise leaves with the energy of the impulse response as its mean square.
    const double decay_per_sample = math::kTwoPi * band.low_hz / (kSqrt2 * sample_rate_hz);
    const auto length = static_cast<std::int64_t>(kTimeConstants / decay_per_sample) + 16;
    double energy = 0;
    for (std::int64_t n = 0; n < length; ++n) {
        const double y = sections_[1].step(sections_[0].step(n == 0 ? 1.0 : 0.0));
        energy += y * y;
    }
    gain_ = 1 / std::sqrt(energy);
    clear();
}

void BandNoise::clear() {
    for (Section& s : sections_) s.s1 = s.s2 = 0;
}

void BandNoise::render(std::uint64_t first, std::span<double> out) {
    Section high_pass = sections_[0], low_pass = sections_[1];
    for (double& y : out) y = gain_ * low_pass.step(high_pass.step(white_.gaussian(first++)));
    sections_ = {high_pass, low_pass};
}

}  // namespace tribo::noise
