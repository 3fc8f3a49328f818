// SPDX-License-Identifier: MIT
#include "noise/play/slow_level.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace tribo::noise {
namespace {

constexpr double kFrameS = 0.01;
constexpr double kReachS = 0.75;       // of the low-pass to each side: falls from 1 to 0 within 2.7 Hz
constexpr double kSilentBelowDb = 60;  // below the loudest frame; quieter frames are set to this level
// Below the loudest slow level. Quieter parts (a hand that reverses or lifts) are not raised further.
constexpr double kRestsBelowDb = 15;

std::vector<double> levels_of(std::span<const double> sound, std::size_t frame) {
    std::vector<double> levels;
    for (std::size_t at = 0; at + frame <= sound.size(); at += frame) {
        double energy = 0;
        for (std::size_t n = at; n < at + frame; ++n) energy += sound[n] * sound[n];
        levels.push_back(10 * math::log10(std::max(energy / static_cast<double>(frame), 1e-30)));
    }
    return levels;
}

// Low-pass by a sinc under a Hann window. The levels are mirrored at both ends.
std::vector<double> low_passed(const std::vector<double>& levels, double corner_hz) {
    const auto reach = static_cast<std::ptrdiff_t>(kReachS / kFrameS);
    std::vector<double> kernel;
    double sum = 0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
        const double t = static_cast<double>(k), x = math::kTwoPi * corner_hz * kFrameS * t;
        const double hann = 0.5 + 0.5 * math::cos(math::kPi * t / static_cast<double>(reach + 1));
        kernel.push_back(hann * (k == 0 ? 1 : math::sin(x) / x));
        sum += kernel.back();
    }
    const auto count = static_cast<std::ptrdiff_t>(levels.size());
    std::vector<double> out(levels.size());
    for (std::ptrdiff_t n = 0; n < count; ++n) {
        double v = 0;
        for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
            const std::ptrdiff_t turn = ((n + k) % (2 * count) + 2 * count) % (2 * count);
            v += kernel[static_cast<std::size_t>(k + reach)] *
                 levels[static_cast<std::size_t>(turn < count ? turn : 2 * count - 1 - turn)];
        }
        out[static_cast<std::size_t>(n)] = v / sum;
    }
    return out;
}

}  // namespace

std::vector<std::vector<double>> without_slow_level(std::span<const std::span<const double>> pieces,
                                                    double sample_rate_hz) {
    const auto frame = static_cast<std::size_t>(kFrameS * sample_rate_hz);
    std::vector<std::vector<double>> out, levels;
    double loudest = -300;
    for (const std::span<const double> piece : pieces) {
        out.emplace_back(piece.begin(), piece.end());
        levels.push_back(levels_of(piece, frame));
        for (const double level : levels.back()) loudest = std::max(loudest, level);
    }
    double mean = 0, count = 0;
    for (std::vector<double>& piece : levels) {
        for (double& level : piece) {
            level = std::max(level, loudest - kSilentBelowDb);
            mean += level;
            ++count;
        }
    }
    mean /= std::max(count, 1.0);
    double below = 0, octave_more = 0, top = -300;  // sums of squares; the loudest level
    std::vector<std::vector<double>> slow;
    for (const std::vector<double>& piece : levels) {
        slow.push_back(low_passed(piece, kSlowHz));
        for (const double v : slow.back()) {
            below += (v - mean) * (v - mean);
            top = std::max(top, v);
        }
        for (const double v : low_passed(piece, 2 * kSlowHz)) octave_more += (v - mean) * (v - mean);
    }
    // octave_more = 2 below, if the fluctuation per hertz below kSlowHz equals that in the octave above.
    const double excess = below > 0 ? std::clamp(2 - octave_more / below, 0.0, 1.0) : 0;
    // A small excess is chance. A large excess comes from the hand and is removed completely.
    const double share = excess * excess * (3 - 2 * excess);
    for (std::size_t p = 0; p < out.size(); ++p) {
        if (slow[p].empty()) continue;
        std::vector<double> gain;
        for (const double v : slow[p]) {
            gain.push_back(math::pow(10, -0.05 * share * (std::max(v, top - kRestsBelowDb) - mean)));
        }
        for (std::size_t n = 0; n < out[p].size(); ++n) {
            const double place = std::clamp((static_cast<double>(n) + 0.5) / static_cast<double>(frame) - 0.5,
                                            0.0, static_cast<double>(gain.size() - 1));
            const auto index = static_cast<std::size_t>(place);
            const double part = place - static_cast<double>(index);
            const double next = gain[std::min(index + 1, gain.size() - 1)];
            out[p][n] *= (1 - part) * gain[index] + part * next;
        }
    }
    return out;
}

}  // namespace tribo::noise
