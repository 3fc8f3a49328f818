// SPDX-License-Identifier: MIT
#include "noise/learn/recording.hpp"

#include <algorithm>
#include <cmath>

#include "base/limits.hpp"
#include "base/math.hpp"
#include "base/text/decimal.hpp"

namespace tribo::noise {
namespace {

constexpr double kFrameS = 0.01;
constexpr double kSilentBelowDb = 50;  // below the loudest tenth
constexpr double kShortestSilenceS = 0.25;
constexpr double kShortestConstantS = 0.02;
constexpr double kSilentPower = 1e-10;  // -100 dB of full scale: nothing was recorded
constexpr int kShortestClip = 3;
constexpr double kNearPeak = 0.9999;
constexpr double kLeastClipLevel = 0.25;  // flat peaks far below full scale are not clipping

double db_of_power(double power) {
    return 10 * math::log10(std::max(power, 1e-40));
}

// Rounded to tenths of a per cent.
std::string percent(double share) {
    return format_decimal(std::round(1000 * share) / 10) + " %";
}

// Second-order Butterworth high-pass (bilinear transform). Its initial state is that of a constant input
// equal to the first sample.
void high_pass(std::vector<double>& x, double corner_hz, double rate_hz) {
    const double k = math::tan(math::kPi * corner_hz / rate_hz);
    const double a0 = 1 + std::sqrt(2.0) * k + k * k;
    const double b = 1 / a0, a1 = 2 * (k * k - 1) / a0, a2 = (1 - std::sqrt(2.0) * k + k * k) / a0;
    double s1 = -b * x[0], s2 = b * x[0];
    for (double& v : x) {
        const double y = b * v + s1;
        s1 = -2 * b * v - a1 * y + s2;
        s2 = b * v - a2 * y;
        v = y;
    }
}

void remove_mean(std::vector<double>& x) {
    double mean = 0;
    for (const double v : x) mean += v;
    mean /= static_cast<double>(x.size());
    for (double& v : x) v -= mean;
}

std::size_t clipped_samples(std::span<const double> x, double peak) {
    if (peak < kLeastClipLevel) return 0;
    std::size_t clipped = 0;
    for (std::size_t n = 0; n < x.size();) {
        std::size_t end = n + 1;
        if (std::abs(x[n]) >= kNearPeak * peak) {
            while (end < x.size() && std::abs(x[end] - x[n]) <= (1 - kNearPeak) * peak) ++end;
            if (end - n >= kShortestClip) clipped += end - n;
        }
        n = end;
    }
    return clipped;
}

// Marks the frames of silence in a recording. `raw` is the sound before the high-pass, `sound` after it.
std::vector<bool> silent_frames(std::span<const double> raw, std::span<const double> sound, std::size_t frame,
                                double rate_hz) {
    const std::size_t count = (sound.size() + frame - 1) / frame;
    std::vector<double> power(count);
    std::vector<bool> constant(count);
    for (std::size_t f = 0; f < count; ++f) {
        const std::size_t begin = f * frame, end = std::min(begin + frame, sound.size());
        for (std::size_t n = begin; n < end; ++n) power[f] += sound[n] * sound[n];
        power[f] /= static_cast<double>(end - begin);
        const auto [least, most] = std::minmax_element(raw.begin() + static_cast<std::ptrdiff_t>(begin),
                                                       raw.begin() + static_cast<std::ptrdiff_t>(end));
        constant[f] = *least == *most;
    }
    std::vector<double> sorted = power;
    std::ranges::sort(sorted);
    const double floor =
        std::max(sorted[static_cast<std::size_t>(0.9 * static_cast<double>(count - 1))] * 1e-5, kSilentPower);
    static_assert(kSilentBelowDb == 50);  // the 1e-5
    std::vector<bool> silent(count);
    const auto mark = [&](auto is_quiet, double shortest_s) {
        const auto least = static_cast<std::size_t>(shortest_s * rate_hz / static_cast<double>(frame));
        for (std::size_t f = 0; f < count;) {
            std::size_t end = f;
            while (end < count && is_quiet(end)) ++end;
            if (end - f >= std::max<std::size_t>(least, 1)) {
                for (std::size_t g = f; g < end; ++g) silent[g] = true;
            }
            f = end + 1;
        }
    };
    mark([&](std::size_t f) { return power[f] < floor; }, kShortestSilenceS);
    mark([&](std::size_t f) { return static_cast<bool>(constant[f]); }, kShortestConstantS);
    // Also mark the neighbouring frames: an edge where sound begins or ends inside a frame would click.
    std::vector<bool> wider = silent;
    for (std::size_t f = 0; f < count; ++f) {
        if (silent[f] && f > 0) wider[f - 1] = true;
        if (silent[f] && f + 1 < count) wider[f + 1] = true;
    }
    return wider;
}

}  // namespace

std::vector<std::span<const double>> PreparedRecording::pieces() const {
    std::vector<std::span<const double>> all;
    for (std::size_t n = 0; n < stretches.size(); ++n) {
        const std::size_t end = n + 1 < stretches.size() ? stretches[n + 1] : sound.size();
        all.push_back(std::span(sound).subspan(stretches[n], end - stretches[n]));
    }
    return all;
}

Result<PreparedRecording> prepare(const Recording& recording, double highpass_hz) {
    const auto refuse = [&](std::string cause, std::string remedy) {
        return fail_at(recording.name, 0, 0, std::move(cause), std::move(remedy));
    };
    if (recording.samples.empty()) return refuse("holds no sound", "give a recording of friction");
    double peak = 0;
    for (const double v : recording.samples) {
        if (!std::isfinite(v))
            return refuse("holds samples that are no numbers", "record or convert it anew");
        peak = std::max(peak, std::abs(v));
    }
    // Its voice would be louder than a material may be.
    if (20 * math::log10(std::max(peak, 1e-300)) > kLimits.voice_level.range.max)
        return refuse("holds a sample of " + format_decimal(static_cast<float>(peak)) + " times full scale",
                      "record or convert it anew");
    const auto too_short = [&](double seconds) {
        return refuse("holds only " + format_decimal(std::round(1000 * seconds)) + " ms of sound",
                      "give at least " + format_decimal(kShortestS) + " s, better several seconds");
    };
    const double lasts_s = static_cast<double>(recording.samples.size()) / recording.sample_rate_hz;
    if (lasts_s < kShortestS) return too_short(lasts_s);
    PreparedRecording out;
    out.peak_db = db_of_power(peak * peak);
    const auto all = static_cast<double>(recording.samples.size());
    out.clipped_share = static_cast<double>(clipped_samples(recording.samples, peak)) / all;
    if (out.clipped_share > 0) {
        out.warnings.push_back(
            {recording.name, 0,
             percent(out.clipped_share) + " of the samples are clipped; record at a lower gain"});
    }
    out.sample_rate_hz = std::min(recording.sample_rate_hz, kFastestLearnedHz);
    const std::vector<double> raw =
        recording.sample_rate_hz > kFastestLearnedHz
            ? brought_down(recording.samples, recording.sample_rate_hz, kFastestLearnedHz)
            : recording.samples;
    std::vector<double> sound = raw;
    if (highpass_hz > 0) {
        high_pass(sound, highpass_hz, out.sample_rate_hz);
    } else {
        remove_mean(sound);
    }
    const auto frame = static_cast<std::size_t>(kFrameS * out.sample_rate_hz);
    const std::vector<bool> silent = silent_frames(raw, sound, frame, out.sample_rate_hz);
    out.stretches.clear();
    double energy = 0;
    for (std::size_t f = 0; f < silent.size(); ++f) {
        if (silent[f]) continue;
        if (f == 0 || silent[f - 1]) out.stretches.push_back(out.sound.size());
        const std::size_t begin = f * frame, end = std::min(begin + frame, sound.size());
        for (std::size_t n = begin; n < end; ++n) {
            out.sound.push_back(sound[n]);
            energy += sound[n] * sound[n];
        }
    }
    const auto kept = static_cast<double>(out.sound.size());
    if (out.sound.empty() || energy / kept < kSilentPower) {
        return refuse("is silent", "give a recording in which the material is rubbed");
    }
    out.silent_share = 1 - kept / static_cast<double>(sound.size());
    if (kept < kShortestS * out.sample_rate_hz) return too_short(kept / out.sample_rate_hz);
    if (out.silent_share > 0.001) {
        out.warnings.push_back(
            {recording.name, 0, percent(out.silent_share) + " of it is silence, left out"});
    }
    out.level_db = db_of_power(energy / kept);
    return out;
}

std::vector<double> brought_down(std::span<const double> samples, double from_hz, double to_hz) {
    // Tabulated sinc with 48 zero crossings on each side, at 0.95 of the new half rate, under a Blackman
    // window.
    constexpr int kSide = 48, kPerCrossing = 256;
    const double ratio = from_hz / to_hz, cutoff = 0.95 / ratio;  // relative to the old half rate
    std::vector<double> table(kSide * kPerCrossing + 2);
    for (std::size_t n = 0; n < table.size(); ++n) {
        const double t = static_cast<double>(n) / kPerCrossing, x = math::kPi * t;
        const double u = math::kPi * std::min(t / kSide, 1.0);
        const double window = 0.42 + 0.5 * math::cos(u) + 0.08 * math::cos(2 * u);
        table[n] = cutoff * window * (n == 0 ? 1 : math::sin(x) / x);
    }
    const auto last = static_cast<std::ptrdiff_t>(samples.size()) - 1;
    std::vector<double> out(static_cast<std::size_t>(static_cast<double>(samples.size()) / ratio));
    for (std::size_t n = 0; n < out.size(); ++n) {
        const double at = static_cast<double>(n) * ratio;
        const auto first =
            std::max<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::ceil(at - kSide / cutoff)), 0);
        const auto end =
            std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::floor(at + kSide / cutoff)), last);
        double sum = 0;
        for (std::ptrdiff_t m = first; m <= end; ++m) {
            const double place = std::abs(static_cast<double>(m) - at) * cutoff * kPerCrossing;
            const auto index = std::min(static_cast<std::size_t>(place), table.size() - 2);
            const double share = place - static_cast<double>(index);
            sum += samples[static_cast<std::size_t>(m)] *
                   ((1 - share) * table[index] + share * table[index + 1]);
        }
        out[n] = sum;
    }
    return out;
}

}  // namespace tribo::noise
