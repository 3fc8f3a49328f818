// SPDX-License-Identifier: MIT
#include "noise/play/friction_voice.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/math.hpp"
#include "base/noise_hash.hpp"
#include "noise/play/noise_kernels.hpp"

namespace tribo::noise {
namespace {

constexpr double kQuantumS = 64.0 / 48000;
constexpr double kSmoothingS = 0.001;
// A slower finger stands still: its level is at least 40 dB below that at 100 mm/s.
constexpr double kStandstillMmPerS = 0.01;
constexpr double kNoForceN = 1e-4;

int quantum_of(const FrictionOptions& options) {
    if (options.quantum_frames > 0) return options.quantum_frames;
    int frames = kNoiseBlock;
    while (frames > 1 && frames > 1.5 * kQuantumS * options.sample_rate_hz) frames /= 2;
    return frames;
}

double finite_size(double value) {
    return std::isfinite(value) ? std::max(value, 0.0) : 0;
}

}  // namespace

FrictionVoice::FrictionVoice(const MaterialVoices& voices, const FrictionOptions& options)
    : options_(options), map_(voices), quantum_(quantum_of(options)) {
    assert(quantum_ >= 1 && kNoiseBlock % quantum_ == 0);
    std::vector<ArModel> models;
    std::size_t order = 0;
    for (const VoiceModel& v : voices.models) {
        double power = 1;
        models.push_back(at_rate(v.spectrum, options.sample_rate_hz, &power));
        band_.push_back(static_cast<float>(std::sqrt(power)));
        order = std::max(order, models.back().reflection.size());
    }
    const CounterNoise seeds(options.seed);
    if (options.interpolation == Interpolation::line_spectrum && !options.as_published) {
        for (ArModel& model : models) {
            model.reflection.resize(order);
            lines_.push_back(line_spectrum_of(model.reflection));
        }
        line_.resize(order);
        predictor_.resize(order);
        reflection_.resize(order);
        line_work_.resize(2 * (order + 2));
        models.resize(1);
    }
    for (std::size_t n = 0; n < models.size(); ++n) {
        const auto& texture = voices.models[n].texture;
        const bool plain = !texture || options.as_published || options.gaussian || !lines_.empty();
        noises_.emplace_back(models[n], plain ? nullptr : &*texture, seeds.bits(n));
    }
    gain_.resize(noises_.size());
    next_gain_.resize(noises_.size());
    smoothing_ = 1 - math::exp(-quantum_ / (kSmoothingS * options.sample_rate_hz));
}

void FrictionVoice::set_target(double speed_mm_per_s, double force_n) {
    target_speed_ = finite_size(speed_mm_per_s);
    target_force_ = finite_size(force_n);
}

double FrictionVoice::target_gain() const {
    if (options_.as_published) return target_force_ > 0 ? map_.as_published(target_speed_).gain : 0;
    return map_.at(target_speed_, target_force_).gain;
}

void FrictionVoice::smooth_targets() {
    // A touch begins at its own force and speed without smoothing from zero: the ramp of the gain is smooth
    // enough.
    if (force_ == 0) force_ = target_force_;
    if (options_.as_published) {
        speed_ = target_speed_;
        force_ = target_force_;
        return;
    }
    speed_ += smoothing_ * (target_speed_ - speed_);
    force_ += smoothing_ * (target_force_ - force_);
    if (target_speed_ == 0 && speed_ < kStandstillMmPerS) speed_ = 0;
    if (target_force_ == 0 && force_ < kNoForceN) force_ = 0;
}

void FrictionVoice::add(ModelNoise& noise, float from, float to) {
    const double travel_mm = speed_ * kNoiseBlock / options_.sample_rate_hz;
    const float* y = noise.block(frame_ / kNoiseBlock, travel_mm).data() + frame_ % kNoiseBlock;
    if (quantum_ % 8 == 0) return noise_kernels().mix(y, from, to, ready_.data(), quantum_);
    const float step = (to - from) / static_cast<float>(quantum_);
    for (int n = 0; n < quantum_; ++n) {
        ready_[static_cast<std::size_t>(n)] += y[n] * (from + step * static_cast<float>(n + 1));
    }
}

void FrictionVoice::mix_models(const VoicePlace& place) {
    std::fill(next_gain_.begin(), next_gain_.end(), 0.0F);
    for (std::size_t n = 0; n < static_cast<std::size_t>(place.count); ++n) {
        const auto model = static_cast<std::size_t>(place.model[n]);
        const double amplitude = options_.as_published ? place.share[n] : std::sqrt(place.share[n]);
        next_gain_[model] = static_cast<float>(place.gain * amplitude) * band_[model];
    }
    for (std::size_t n = 0; n < noises_.size(); ++n) {
        const bool silent = gain_[n] == 0 && next_gain_[n] == 0;
        if (!silent || (options_.as_published && place.count > 0)) add(noises_[n], gain_[n], next_gain_[n]);
    }
}

void FrictionVoice::move_lines(const VoicePlace& place) {
    next_gain_[0] = 0;
    if (place.gain > 0) {
        std::fill(line_.begin(), line_.end(), 0.0);
        double power = 0;
        for (std::size_t n = 0; n < static_cast<std::size_t>(place.count); ++n) {
            const auto model = static_cast<std::size_t>(place.model[n]);
            power += place.share[n] * band_[model] * band_[model];
            for (std::size_t k = 0; k < line_.size(); ++k) line_[k] += place.share[n] * lines_[model][k];
        }
        if (frame_ % kNoiseBlock == 0) {
            predictor_from_line_spectrum(line_, predictor_, line_work_);
            std::copy(predictor_.begin(), predictor_.end(), line_work_.begin());
            reflection_of(std::span(line_work_).first(predictor_.size()), reflection_);
            noises_[0].retune(predictor_, std::sqrt(std::max(innovation_power(reflection_), 0.0)));
        }
        next_gain_[0] = static_cast<float>(place.gain * std::sqrt(power));
    }
    if (gain_[0] != 0 || next_gain_[0] != 0) add(noises_[0], gain_[0], next_gain_[0]);
}

void FrictionVoice::next_quantum() {
    smooth_targets();
    ready_.fill(0);
    const VoicePlace place = !options_.as_published ? map_.at(speed_, force_)
                             : force_ > 0           ? map_.as_published(speed_)
                                                    : VoicePlace{};
    if (lines_.empty()) {
        mix_models(place);
    } else {
        move_lines(place);
    }
    for (float& x : ready_) x = std::clamp(x, -1.0F, 1.0F);
    std::swap(gain_, next_gain_);
}

void FrictionVoice::render(std::span<float> out) {
    const auto quantum = static_cast<std::size_t>(quantum_);
    for (std::size_t done = 0; done < out.size();) {
        const auto at = static_cast<std::size_t>(frame_ % quantum);
        if (at == 0) next_quantum();
        const std::size_t count = std::min(out.size() - done, quantum - at);
        std::copy_n(ready_.begin() + static_cast<std::ptrdiff_t>(at), count,
                    out.begin() + static_cast<std::ptrdiff_t>(done));
        done += count;
        frame_ += count;
    }
}

void FrictionVoice::seek(std::uint64_t frame) {
    frame_ = frame / static_cast<std::uint64_t>(quantum_) * static_cast<std::uint64_t>(quantum_);
    for (ModelNoise& noise : noises_) noise.seek(frame_ / kNoiseBlock);
    std::fill(gain_.begin(), gain_.end(), 0.0F);
    speed_ = force_ = target_speed_ = target_force_ = 0;
}

}  // namespace tribo::noise
