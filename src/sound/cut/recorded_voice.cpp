// SPDX-License-Identifier: MIT
#include "sound/cut/recorded_voice.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/math.hpp"
#include "sound/cut/partials.hpp"
#include "sound/play/calibration.hpp"

namespace tribo::sound {
namespace {

constexpr double kLeastTurns = 4, kMostSeconds = 120;
constexpr double kLeastRms = 1e-5;  // of full scale; less is silence
constexpr std::size_t kMargin = kInterpolatorTaps;

double rms(const std::vector<float>& x) {
    double sum = 0;
    for (const float v : x) sum += static_cast<double>(v) * static_cast<double>(v);
    return x.empty() ? 0 : std::sqrt(sum / static_cast<double>(x.size()));
}

// The loop, low-passed to `share` of half its rate: a Hann-windowed sinc, around the seam.
std::vector<float> low_passed(const std::vector<float>& loop, double share) {
    constexpr int kHalf = 64;
    std::array<double, 2 * kHalf + 1> h;
    double sum = 0;
    for (int k = -kHalf; k <= kHalf; ++k) {
        const double x = math::kPi * share * k;
        const double w = 0.5 + 0.5 * math::cos(math::kPi * k / (kHalf + 1));
        sum += h[static_cast<std::size_t>(k + kHalf)] = w * (k == 0 ? 1 : math::sin(x) / x);
    }
    std::vector<float> wide(loop.size() + 2 * kHalf), out(loop.size());
    for (std::size_t n = 0; n < wide.size(); ++n) {
        wide[n] = loop[(n + loop.size() - kHalf % loop.size()) % loop.size()];
    }
    std::array<float, h.size()> taps;
    for (std::size_t k = 0; k < h.size(); ++k) taps[k] = static_cast<float>(h[k] / sum);
    for (std::size_t n = 0; n < out.size(); ++n) {
        float y[4]{};
        for (std::size_t k = 0; k + 4 <= taps.size(); k += 4) {
            for (std::size_t i = 0; i < 4; ++i) y[i] += taps[k + i] * wide[n + k + i];
        }
        out[n] = ((y[0] + y[1]) + (y[2] + y[3])) + taps.back() * wide[n + taps.size() - 1];
    }
    return out;
}

}  // namespace

Result<void> check_recording(const Recording& r) {
    const auto bad = [](const std::string& cause) {
        return fail(cause, "try an even stretch of some seconds, with the speed at which it was recorded");
    };
    if (!(r.sample_rate_hz >= 4000 && r.sample_rate_hz <= 384000)) {
        return bad("the recording has no sample rate between 4 and 384 kHz");
    }
    if (!(r.spindle_rpm > 0 && r.spindle_rpm <= 1e6))
        return bad("the recording's spindle speed is not known");
    const double seconds = static_cast<double>(r.samples.size()) / r.sample_rate_hz;
    if (!(seconds * r.spindle_rpm / 60 >= kLeastTurns))
        return bad("the recording holds less than four turns");
    if (seconds > kMostSeconds) return bad("the recording is longer than two minutes");
    for (const float v : r.samples) {
        if (!std::isfinite(v)) return bad("the recording holds a number that is none");
    }
    if (rms(r.samples) < kLeastRms) return bad("the recording is silent");
    return {};
}

RecordedVoice::RecordedVoice(const Recording& recording, const RecordedVoiceOptions& options)
    : options_(options), table_(&interpolator_table()) {
    assert(check_recording(recording));
    body_.set(options.cut.body, options.sample_rate_hz);
    const std::vector<float>& from = recording.samples;
    frames_per_turn_ = recording.sample_rate_hz * 60 / recording.spindle_rpm;
    const double turns = std::floor(static_cast<double>(from.size()) / frames_per_turn_);
    // A quarter of the turns, at least one, make the seam.
    const double seam_turns = std::max(1.0, std::floor(turns / 4));
    const auto loop = static_cast<std::size_t>((turns - seam_turns) * frames_per_turn_ + 0.5);
    const std::size_t seam =
        std::min(from.size() - loop, static_cast<std::size_t>(seam_turns * frames_per_turn_));
    loop_frames_ = static_cast<double>(loop);

    double power_a = 0, power_b = 0, both = 0;  // of the seam's two sides
    for (std::size_t n = 0; n < seam; ++n) {
        const auto a = static_cast<double>(from[n]), b = static_cast<double>(from[loop + n]);
        power_a += a * a;
        power_b += b * b;
        both += a * b;
    }
    const double alike = power_a * power_b > 0 ? both / std::sqrt(power_a * power_b) : 0;
    copies_[0].assign(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(loop));
    for (std::size_t n = 0; n < seam && n < loop; ++n) {
        double in, out;
        math::sincos(math::kHalfPi * (static_cast<double>(n) + 0.5) / static_cast<double>(seam), in, out);
        const double level = std::sqrt(std::max(0.1, 1 + 2 * in * out * alike));
        copies_[0][n] = static_cast<float>(
            (in * static_cast<double>(from[n]) + out * static_cast<double>(from[loop + n])) / level);
    }
    const auto gain = static_cast<float>(1 / std::max(rms(copies_[0]), kLeastRms));
    for (float& v : copies_[0]) v *= gain;
    copies_[1] = low_passed(copies_[0], 0.5);
    copies_[2] = low_passed(copies_[0], 0.25);
    for (std::vector<float>& copy : copies_) {
        copy.insert(copy.begin(), copy.end() - kMargin, copy.end());
        copy.insert(copy.end(), copy.begin() + kMargin, copy.begin() + 2 * kMargin);
    }
}

void RecordedVoice::excite(const contact::ContactSample& next, std::int64_t quanta) {
    rate_.set_target(std::abs(next.phase_rate_rad_per_s) / math::kTwoPi / options_.sample_rate_hz, quanta);
    const double rate = rate_.target();
    if (options_.idle_pa > 0) {
        level_.jump_to(rate > 0 ? options_.idle_pa : 0);
    } else {
        const CutNoise noise = noise_of(options_.cut, next);
        double power = noise.chips_pa * noise.chips_pa + noise.body_pa * noise.body_pa;
        if (next.spectrum != nullptr) {
            const Partials p = in_plane_partials(*next.spectrum, kPascalPerNewton);
            const double hz = rate * options_.sample_rate_hz * next.spectrum->order_step;
            for (std::size_t n = 0; n < static_cast<std::size_t>(p.count); ++n) {
                const double gain = body_.gain_at(hz * static_cast<double>(n + 1));
                power += 2 * gain * gain * (p.re[n] * p.re[n] + p.im[n] * p.im[n]);
            }
        }
        level_.set_target(rate > 0 ? std::sqrt(power) : 0, quanta);
    }
    // A spindle that nobody hears is at its speed.
    if (loudness_.over()) rate_.jump_to(rate);
}

void RecordedVoice::release() {
    level_.jump_to(0);
    rate_.jump_to(rate_.target());
}

double RecordedVoice::read(const std::vector<float>& copy, double place) const {
    const double whole = std::floor(place);
    const auto row = static_cast<std::size_t>((place - whole) * kInterpolatorRows + 0.5);
    const float* c = table_->data() + row * kInterpolatorTaps;
    const float* x = copy.data() + static_cast<std::size_t>(whole) + kMargin - (kInterpolatorAhead - 1);
    double sum = 0;
    for (std::size_t k = 0; k < kInterpolatorTaps; ++k)
        sum += static_cast<double>(c[k]) * static_cast<double>(x[k]);
    return sum;
}

void RecordedVoice::add(Quantum& pressure_pa) {
    const double rate0 = rate_.value(), rate1 = rate_.advance();
    loudness_.follow(options_.share * level_.advance());
    if (loudness_.silent()) return;

    const double step0 = rate0 * frames_per_turn_, step1 = rate1 * frames_per_turn_;
    const double fastest = kFastestPlay;
    // Which copies: the recording as it is up to its own speed, an octave lower at twice that.
    const double octaves =
        std::clamp(step1 > 1 ? math::log(std::min(step1, fastest)) / math::log(2) : 0, 0.0, kCopies - 1.0);
    const auto first = std::min(static_cast<std::size_t>(octaves), static_cast<std::size_t>(kCopies - 2));
    const double blend = octaves - static_cast<double>(first);
    const Spline loud = loudness_.spline();
    for (std::size_t j = 0; j < pressure_pa.size(); ++j) {
        const double t = static_cast<double>(j) * (1.0 / kQuantumFrames);
        double sample = read(copies_[first], place_);
        if (blend > 0) sample += blend * (read(copies_[first + 1], place_) - sample);
        pressure_pa[j] += loud.at(t) * sample;
        place_ += std::min(step0 + t * (step1 - step0), fastest);
        while (place_ >= loop_frames_) place_ -= loop_frames_;
    }
}

}  // namespace tribo::sound
