// SPDX-License-Identifier: MIT
#include "noise/voice_quality.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "noise/levinson.hpp"
#include "noise/model_noise.hpp"
#include "noise/sound_statistics.hpp"

namespace tribo::noise {
namespace {

constexpr double kBlockS = 0.25;
constexpr int kPlainOrder = 50;
constexpr double kPlayedS = 10;
constexpr double kLevelS = 60;  // the level of a textured voice wanders: a long mean
constexpr double kEnvelopeS = 0.002;
constexpr std::size_t kSpectrumFrame = 1024;

using Pieces = std::vector<std::span<const double>>;

double db(double power) {
    return 10 * math::log10(std::max(power, 1e-30));
}

std::vector<double> joined(const Pieces& pieces) {
    std::vector<double> all;
    for (const auto piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
    return all;
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

// Root mean square of the difference of two spectra in dB, their mean difference taken off.
double distance_db(const std::vector<double>& a, const std::vector<double>& b,
                   const std::vector<double>& hz) {
    double sum = 0, square = 0, count = 0;
    for (std::size_t n = 0; n < hz.size(); ++n) {
        if (hz[n] < 200 || hz[n] > 20000) continue;
        const double d = a[n] - b[n];
        sum += d;
        square += d * d;
        ++count;
    }
    return count > 0 ? std::sqrt(std::max(square / count - sum / count * (sum / count), 0.0)) : 0;
}

std::vector<double> spectrum_db(const std::vector<double>& sound) {
    std::vector<double> power = power_spectrum(sound, kSpectrumFrame);
    for (double& p : power) p = db(p);
    return power;
}

std::vector<double> model_spectrum_db(const ArModel& model, const std::vector<double>& hz, double level_db) {
    std::vector<double> power;
    for (const double f : hz) power.push_back(db(power_at(model, f)) + level_db);
    return power;
}

std::vector<double> played(const VoiceModel& model, bool textured, double seconds, std::uint64_t seed) {
    const double rate = model.spectrum.sample_rate_hz;
    ModelNoise noise(model.spectrum, textured && model.texture ? &*model.texture : nullptr, seed);
    const double gain = math::pow(10, 0.05 * model.level_db);
    std::vector<double> x;
    for (std::uint64_t n = 0; static_cast<double>(x.size()) < seconds * rate; ++n) {
        for (const float v : noise.block(n, model.speed_mm_per_s * kNoiseBlock / rate)) x.push_back(gain * v);
    }
    return x;
}

// Fluctuation of the amplitude of 2 ms frames in steps of half an octave from 2 to 200 Hz.
std::vector<double> modulation_db(const std::vector<double>& sound, double rate,
                                  const std::vector<double>& hz) {
    const auto frame = static_cast<std::size_t>(kEnvelopeS * rate);
    std::vector<double> envelope;
    double mean = 0;
    for (std::size_t at = 0; at + frame <= sound.size(); at += frame) {
        double energy = 0;
        for (std::size_t n = at; n < at + frame; ++n) energy += sound[n] * sound[n];
        envelope.push_back(std::sqrt(energy));
        mean += envelope.back();
    }
    mean /= std::max(1.0, static_cast<double>(envelope.size()));
    for (double& v : envelope) v = v / mean - 1;
    const std::vector<double> power = power_spectrum(envelope, 256);
    const double step = 0.5 / kEnvelopeS / static_cast<double>(power.size());
    std::vector<double> levels;
    for (const double f : hz) {
        double sum = 0, count = 0;
        for (std::size_t k = 0; k < power.size(); ++k) {
            const double at = step * (static_cast<double>(k) + 0.5);
            if (at < f * 0.84 || at > f * 1.19) continue;
            sum += power[k];
            ++count;
        }
        levels.push_back(db(count > 0 ? sum / count : 0));
    }
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
    for (std::size_t k = 0; k < q.original_db.size(); ++k) {
        q.hz.push_back(0.5 * rate * (static_cast<double>(k) + 0.5) /
                       static_cast<double>(q.original_db.size()));
    }
    q.model_db = model_spectrum_db(model.spectrum, q.hz, model.level_db);

    const auto order = static_cast<int>(model.spectrum.reflection.size());
    const Pieces first = half_of(sound, rate, 0), second = half_of(sound, rate, 1);
    const std::vector<double> other = spectrum_db(joined(second));
    q.halves_db = distance_db(spectrum_db(joined(first)), other, q.hz);
    const auto held_out = [&](int poles, double corner_hz, double white) {
        const std::vector<double> r = windowed_autocorrelation(first, rate, corner_hz, poles);
        if (!(r[0] > 0)) return 0.0;
        return distance_db(model_spectrum_db({rate, levinson(r, white)}, q.hz, 0), other, q.hz);
    };
    q.held_out_db = held_out(order, highpass_hz, 1e-11);
    q.held_out_plain_db = held_out(kPlainOrder, 0, 0);

    const double seconds = static_cast<double>(sound.size()) / rate;
    const std::vector<double> gaussian = played(model, false, std::min(seconds, kPlayedS), 1);
    const std::vector<double> voice = played(model, true, std::min(seconds, kPlayedS), 1);
    double power = 0;
    const std::vector<double> long_voice = played(model, true, kLevelS, 2);
    for (const double v : long_voice) power += v * v / static_cast<double>(long_voice.size());
    q.level_error_db = db(power) - model.level_db;
    q.kurtosis = {kurtosis(sound), kurtosis(gaussian), kurtosis(voice)};
    q.deviation_db = {level_deviation_db(sound, rate), level_deviation_db(gaussian, rate),
                      level_deviation_db(voice, rate)};
    for (double hz = 5.6; hz < 210; hz *= std::sqrt(2.0)) q.modulation.hz.push_back(hz);
    q.modulation.original_db = modulation_db(sound, rate, q.modulation.hz);
    q.modulation.gaussian_db = modulation_db(gaussian, rate, q.modulation.hz);
    q.modulation.voice_db = modulation_db(voice, rate, q.modulation.hz);
    q.original = heard(sound, rate);
    q.gaussian = heard(gaussian, rate);
    q.voice = heard(voice, rate);
    return q;
}

}  // namespace tribo::noise
