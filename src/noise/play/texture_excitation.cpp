// SPDX-License-Identifier: MIT
#include "noise/play/texture_excitation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/math.hpp"
#include "base/noise_hash.hpp"

namespace tribo::noise {
namespace {

// Samples between two updates of the levels, with linear interpolation: 0.7 ms at 48 kHz.
constexpr int kLevelFrames = 32;
// More grains than this in one block are noise.
constexpr int kMostInBlock = 64;

// Second-order Butterworth low-pass (or high-pass) for one lane. The powers of both add up to 1.
void set_lane(BandSection& s, std::size_t lane, double corner_hz, double rate_hz, bool low) {
    const double k = math::tan(math::kPi * corner_hz / rate_hz);
    const double a0 = 1 + std::sqrt(2.0) * k + k * k;
    const double b = (low ? k * k : 1) / a0;
    s.b0[lane] = s.b2[lane] = static_cast<float>(b);
    s.b1[lane] = static_cast<float>(low ? 2 * b : -2 * b);
    s.a1[lane] = static_cast<float>(2 * (k * k - 1) / a0);
    s.a2[lane] = static_cast<float>((1 - std::sqrt(2.0) * k + k * k) / a0);
}

}  // namespace

void normalize(TextureModel& texture) {
    // Trapezoid rule over g, finer than the table.
    constexpr int kFiner = 8;
    for (std::vector<double>& table : texture.levels_db) {
        double sum = 0, weights = 0;
        for (int n = 0; n <= (kLevelSteps - 1) * kFiner; ++n) {
            const double place = static_cast<double>(n) / kFiner;
            const auto index = std::min(static_cast<std::size_t>(place), table.size() - 2);
            const double share = place - static_cast<double>(index);
            const double g = -kLevelReach + 0.5 * place;
            const double w = math::exp(-0.5 * g * g);
            // The playback is linear in amplitude between two steps.
            const double amplitude = (1 - share) * math::pow(10, 0.05 * table[index]) +
                                     share * math::pow(10, 0.05 * table[index + 1]);
            sum += w * amplitude * amplitude;
            weights += w;
        }
        const double shift = 10 * math::log10(sum / weights);
        for (double& level : table) level -= shift;
    }
}

TextureExcitation::TextureExcitation(const TextureModel& texture, double sample_rate_hz, std::uint64_t seed)
    : key_(CounterNoise(seed).bits(1)) {
    std::array<double, kMostBands - 1> corners{};
    int count = 0;
    // Leave out bands that the sample rate cannot carry.
    for (const double hz : texture.crossovers_hz) {
        if (hz < 0.45 * sample_rate_hz) corners[static_cast<std::size_t>(count++)] = hz;
    }
    bands_ = count + 1;
    for (std::size_t lane = 0; lane < kMostBands; ++lane) {
        keys_[lane] = static_cast<std::uint32_t>(CounterNoise(seed).bits(100 + lane));
        for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
            if (k <= lane && lane < static_cast<std::size_t>(bands_)) {
                set_lane(sections_[k], lane, corners[k], sample_rate_hz, lane == k);
            } else {
                sections_[k].b0[lane] = 1;
            }
        }
    }
    for (std::size_t band = 0; band < static_cast<std::size_t>(bands_); ++band) {
        for (std::size_t n = 0; n < kLevelSteps; ++n) {
            amplitude_[band][n] = static_cast<float>(math::pow(10, 0.05 * texture.levels_db[band][n]));
        }
    }
    lengths_ = static_cast<int>(texture.lengths_mm.size());
    std::ranges::copy(texture.lengths_mm, length_mm_.begin());
    std::ranges::transform(texture.weights, weight_.begin(), [](double w) { return std::sqrt(w); });
    common_ = std::sqrt(texture.coherence);
    own_ = std::sqrt(1 - texture.coherence);

    const GrainModel& grains = texture.grains;
    per_mm_ = grains.sizes.empty() ? 0 : grains.per_mm;
    share_ = per_mm_ > 0 ? grains.share : 0;
    scatter_ = grains.scatter;
    taps_ = grains.shape.empty() ? 1 : static_cast<int>(grains.shape.size());
    shape_[0] = 1;
    std::ranges::transform(grains.shape, shape_.begin(), [](double v) { return static_cast<float>(v); });
    sizes_ = static_cast<int>(grains.sizes.size());
    std::ranges::copy(grains.sizes, size_.begin());
    if (sizes_ > 0) {
        double sum = 0;
        for (const double size : grains.sizes) sum += size * size;
        mean_square_ = sum / sizes_;
        if (!(mean_square_ > 0)) per_mm_ = share_ = 0;
    }
    restart();
}

void TextureExcitation::restart() {
    drawn_ = 0;
    const CounterNoise random(key_);
    for (auto& process : state_) {
        for (double& x : process) x = random.gaussian(drawn_++);
    }
    for (BandSection& s : sections_) {
        std::fill(std::begin(s.s1), std::end(s.s1), 0.0F);
        std::fill(std::begin(s.s2), std::end(s.s2), 0.0F);
    }
    for (std::size_t n = 0; n < order_.size(); ++n) order_[n] = static_cast<std::uint8_t>(n);
    sizes_left_ = 0;
    to_next_mm_ = per_mm_ > 0 ? next_gap() * random.uniform(drawn_++) : 0;
    gain_.fill(0);
    tail_.fill(0);
    step_levels(0);
}

double TextureExcitation::next_gap() {
    const double u = CounterNoise(key_).uniform(drawn_++);
    return ((1 - scatter_) - scatter_ * math::log(1 - u)) / per_mm_;
}

// Returns the sizes in rounds: each size occurs once per round. So the few large sizes, which determine the
// kurtosis, are exactly as frequent as in the recording.
double TextureExcitation::next_size() {
    if (sizes_left_ == 0) sizes_left_ = sizes_;
    const double place = CounterNoise(key_).uniform(drawn_++) * sizes_left_;
    --sizes_left_;
    std::uint8_t& drawn = order_[static_cast<std::size_t>(sizes_left_)];
    std::swap(order_[static_cast<std::size_t>(place)], drawn);
    return size_[drawn];
}

double TextureExcitation::level(int band, double g) const {
    const double place = std::clamp((g + kLevelReach) * 2, 0.0, kLevelSteps - 1.0);
    const auto index = std::min(static_cast<std::size_t>(place), std::size_t{kLevelSteps - 2});
    const double share = place - static_cast<double>(index);
    const auto& table = amplitude_[static_cast<std::size_t>(band)];
    return (1 - share) * table[index] + share * table[index + 1];
}

void TextureExcitation::step_levels(double travel_mm) {
    const CounterNoise random(key_);
    std::array<double, kMostLengths> keep{}, renew{};
    for (std::size_t n = 0; n < static_cast<std::size_t>(lengths_); ++n) {
        keep[n] = math::exp(-travel_mm / length_mm_[n]);
        renew[n] = std::sqrt(1 - keep[n] * keep[n]);
    }
    const auto advance = [&](std::array<double, kMostLengths>& process) {
        double g = 0;
        for (std::size_t n = 0; n < static_cast<std::size_t>(lengths_); ++n) {
            process[n] = keep[n] * process[n] + renew[n] * random.gaussian(drawn_++);
            g += weight_[n] * process[n];
        }
        return g;
    };
    const double common = common_ * advance(state_[kMostBands]);
    for (int band = 0; band < bands_; ++band) {
        auto& process = state_[static_cast<std::size_t>(band)];
        const double g = common + (own_ > 0 ? own_ * advance(process) : 0);
        gain_[static_cast<std::size_t>(band)] = static_cast<float>(level(band, g));
    }
}

void TextureExcitation::add_grains(double travel_mm, std::span<float, 64> out) {
    // Grains per sample * their mean square = their share of the power. At another speed than the learned one
    // there are more or fewer grains; the loudness is that of the level law.
    for (std::size_t n = 0; n < out.size(); ++n) out[n] += tail_[n];
    tail_.fill(0);
    const double per_sample = per_mm_ * travel_mm / 64;
    if (!(per_sample > 0)) return;
    const double scale = std::sqrt(share_ / (per_sample * mean_square_));
    for (int n = 0; to_next_mm_ < travel_mm; to_next_mm_ += next_gap()) {
        const auto at = static_cast<std::size_t>(std::min(64 * to_next_mm_ / travel_mm, 63.0));
        const auto size = static_cast<float>(scale * next_size());
        for (std::size_t tap = 0; tap < static_cast<std::size_t>(taps_); ++tap) {
            float& sample = at + tap < out.size() ? out[at + tap] : tail_[at + tap - out.size()];
            sample += size * shape_[tap];
        }
        if (++n == kMostInBlock) {
            to_next_mm_ = travel_mm;
            break;
        }
    }
    to_next_mm_ -= travel_mm;
}

void TextureExcitation::block(std::uint64_t first, double travel_mm, std::span<float, 64> out) {
    const auto background = static_cast<float>(std::sqrt(1 - share_));
    for (int done = 0; done < 64; done += kLevelFrames) {
        const std::array<float, kMostBands> from = gain_;
        if (travel_mm > 0 && lengths_ > 0) step_levels(travel_mm * kLevelFrames / 64);
        std::array<float, kMostBands> start, step;
        for (std::size_t band = 0; band < kMostBands; ++band) {
            start[band] = background * from[band];
            step[band] = background * (gain_[band] - from[band]) / static_cast<float>(kLevelFrames);
        }
        noise_kernels().bands(sections_.data(), bands_ - 1, keys_.data(),
                              static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(done),
                              start.data(), step.data(), out.data() + done, kLevelFrames);
    }
    if (share_ > 0) add_grains(travel_mm, out);
}

}  // namespace tribo::noise
