// SPDX-License-Identifier: MIT
#include "noise/learn/voice_quality.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "noise/learn/sound_statistics.hpp"
#include "noise/model/levinson.hpp"
#include "noise/play/model_noise.hpp"
#include "noise/play/slow_level.hpp"

namespace tribo::noise {
namespace {

constexpr double kBlockS = 0.25;
constexpr int kPlainOrder = 50;
constexpr double kMostPlayedS = 10;
constexpr double kLevelS = 60;  // the level of a textured voice varies slowly, so its mean needs a long time

using Pieces = std::vector<std::span<const double>>;

double decibels(double power) {
    return 10 * math::log10(std::max(power, 1e-30));
}

Pieces half_of(const std::vector<double>& sound, double rate, std::size_t which) {
    Pieces half;
    const auto block =
        std::min(static_cast<std::size_t>(kBlockS * rate), std::max<std::size_t>(sound.size() / 2, 1));
    for (std::size_t at = 0, n = 0; at + block <= sound.size(); at += block, ++n) {
        if (n % 2 == which) half.push_back(std::span(sound).subspan(at, block));
    }
    return half;
}

std::vector<double> played_voice(const VoiceModel& model, bool textured, double seconds, std::uint64_t seed) {
    const double rate = model.spectrum.sample_rate_hz;
    ModelNoise noise(model.spectrum, textured && model.texture ? &*model.texture : nullptr, seed);
    const double gain = math::pow(10, 0.05 * model.level_db);
    std::vector<double> x;
    for (std::uint64_t n = 0; static_cast<double>(x.size()) < seconds * rate; ++n) {
        for (const float v : noise.block(n, model.speed_mm_per_s * kNoiseBlock / rate)) x.push_back(gain * v);
    }
    return x;
}

std::vector<double> modulation_db(const std::vector<double>& sound, double rate,
                                  const std::vector<double>& hz) {
    std::vector<double> levels = modulation_density(sound, rate, hz);
    for (double& v : levels) v = decibels(v);
    return levels;
}

std::vector<float> heard(const std::vector<double>& sound, double rate) {
    const auto count = std::min(sound.size(), static_cast<std::size_t>(kHeardS * rate));
    std::vector<float> out;
    for (std::size_t n = 0; n < count; ++n) out.push_back(static_cast<float>(sound[n]));
    return out;
}

}  // namespace

VoiceQuality quality_of(const VoiceModel& model, const PreparedRecording& recording, double highpass_hz) {
    VoiceQuality q;
    const double rate = q.sample_rate_hz = recording.sample_rate_hz;
    const std::vector<double>& sound = recording.sound;
    q.original_db = spectrum_db(sound);
    q.hz = spectrum_hz(rate);
    q.model_db = spectrum_db(model.spectrum, q.hz, model.level_db);

    const auto order = static_cast<int>(model.spectrum.reflection.size());
    const Pieces first = half_of(sound, rate, 0), second = half_of(sound, rate, 1);
    const std::vector<double> other = spectrum_db(second);
    q.halves_db = shape_distance_db(spectrum_db(first), other, q.hz);
    const auto held_out = [&](int poles, double corner_hz, double white) {
        const std::vector<double> r = windowed_autocorrelation(first, rate, corner_hz, poles);
        if (!(r[0] > 0)) return 0.0;
        return shape_distance_db(spectrum_db({rate, levinson(r, white)}, q.hz), other, q.hz);
    };
    q.held_out_db = held_out(order, highpass_hz, 1e-11);
    q.held_out_plain_db = held_out(kPlainOrder, 0, 0);

    const double seconds = static_cast<double>(sound.size()) / rate;
    const std::vector<double> gaussian = played_voice(model, false, std::min(seconds, kMostPlayedS), 1);
    const std::vector<double> voice = played_voice(model, true, std::min(seconds, kMostPlayedS), 1);
    double power = 0;
    const std::vector<double> long_voice = played_voice(model, true, kLevelS, 2);
    for (const double v : long_voice) power += v * v / static_cast<double>(long_voice.size());
    q.level_error_db = decibels(power) - model.level_db;
    // Remove the slow level of the hand: in playback it comes from the stroke.
    std::vector<double> levelled;
    for (const std::vector<double>& piece : without_slow_level(recording.pieces(), rate)) {
        levelled.insert(levelled.end(), piece.begin(), piece.end());
    }
    q.kurtosis = {kurtosis(sound), kurtosis(gaussian), kurtosis(voice)};
    q.deviation_db = {level_deviation_db(levelled, rate), level_deviation_db(gaussian, rate),
                      level_deviation_db(voice, rate)};
    for (double hz = 5.6; hz < 210; hz *= std::sqrt(2.0)) q.modulation.hz.push_back(hz);
    q.modulation.original_db = modulation_db(levelled, rate, q.modulation.hz);
    q.modulation.gaussian_db = modulation_db(gaussian, rate, q.modulation.hz);
    q.modulation.voice_db = modulation_db(voice, rate, q.modulation.hz);
    q.original = heard(sound, rate);
    q.gaussian = heard(gaussian, rate);
    q.voice = heard(voice, rate);
    return q;
}

}  // namespace tribo::noise
