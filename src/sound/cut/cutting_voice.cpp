// SPDX-License-Identifier: MIT
#include "sound/cut/cutting_voice.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "sound/cut/vibration_voice.hpp"
#include "sound/play/calibration.hpp"

namespace tribo::sound {
namespace {

// What a step of an amplitude takes; shorter is heard as a click, longer blurs the bite of the cutter.
constexpr double kStepSeconds = 0.010;
// Swing of the chip noise with the partials, as a share of its level.
constexpr double kNoiseSwing = 0.5;
constexpr double kMmPerM = 1000;

CutNoise mix(const CutNoise& a, const CutNoise& b, double t) {
    return {a.body_pa + t * (b.body_pa - a.body_pa), a.chips_pa + t * (b.chips_pa - a.chips_pa),
            a.coarse + t * (b.coarse - a.coarse)};
}

// Partials beside a vibration are heard with its phase.
template <class Response>
void turn(Partials& partials, Response&& response) {
    for (std::size_t n = 0; n < static_cast<std::size_t>(partials.count); ++n) {
        const std::complex<double> turned =
            std::complex<double>(partials.re[n], partials.im[n]) * response(static_cast<double>(n + 1));
        partials.re[n] = turned.real();
        partials.im[n] = turned.imag();
    }
}

}  // namespace

CutNoise noise_of(const CutSound& sound, const contact::ContactSample& cut) {
    CutNoise noise;
    if (sound.sound_share > 0 && cut.spectrum != nullptr) {
        const double watts =
            std::abs(mean_force(*cut.spectrum).torque_nmm * cut.phase_rate_rad_per_s) / kMmPerM;
        noise.body_pa = std::sqrt(sound.sound_share * watts * kAirImpedance / (2 * math::kTwoPi));
    }
    if (sound.chips.sounds()) {
        const Chips chips = chips_of(cut);
        noise.chips_pa = sound.chips.level * chip_pressure_pa(chips);
        noise.coarse = coarseness(chips.mm3);
    }
    if (sound.chips.learned) {
        noise.chips_pa = std::sqrt(noise.chips_pa * noise.chips_pa + noise.body_pa * noise.body_pa);
        noise.body_pa = 0;
    }
    return noise;
}

CuttingVoice::CuttingVoice(const CuttingVoiceOptions& options)
    : options_(options),
      pink_(options.seed, options.sample_rate_hz),
      chips_(options.sound.chips, options.sample_rate_hz, options.seed) {
    bell_size_ = static_cast<std::size_t>(
        std::clamp(std::floor(kStepSeconds * options.sample_rate_hz / kQuantumFrames + 0.5), 2.0,
                   static_cast<double>(kMaxKernel)));
    double sum = 0;
    for (std::size_t k = 0; k < bell_size_; ++k) {
        bell_[k] =
            1 - math::cos(math::kTwoPi * static_cast<double>(k + 1) / static_cast<double>(bell_size_ + 1));
        sum += bell_[k];
    }
    for (std::size_t k = 0; k < bell_size_; ++k) bell_[k] /= sum;
    body_.set(options.sound.body, options.sample_rate_hz);
    const double gain = body_.gain_of_pink();
    pink_gain_ = gain > 0 ? 1 / gain : 0;
}

CuttingVoice::Excitation CuttingVoice::now() const {
    if (elapsed_ >= length_) return to_;
    if (waits_) return from_;
    const double t = static_cast<double>(elapsed_) / static_cast<double>(length_);
    return {to_.step,
            {mix(from_.level.partials, to_.level.partials, t), mix(from_.level.noise, to_.level.noise, t)}};
}

void CuttingVoice::excite(const contact::ContactSample& next, std::int64_t quanta) {
    from_ = now();
    const bool was_in_contact = !to_.level.partials.silent();
    to_.level.partials =
        next.spectrum != nullptr ? in_plane_partials(*next.spectrum, kPascalPerNewton) : Partials{};
    if (next.vibration != nullptr) {
        const double hz =
            next.phase_rate_rad_per_s * (next.spectrum ? next.spectrum->order_step : 1) / math::kTwoPi;
        turn(to_.level.partials,
             [&](double order) { return vibration_response(order * hz, next.vibration->rate_hz); });
    }
    to_.level.noise = noise_of(options_.sound, next);
    to_.step = to_.level.partials.silent() ? from_.step : next.spectrum->order_step;
    if (to_.step != from_.step) {
        from_.step = to_.step;
        from_.level.partials = {};
    }
    length_ = quanta;
    elapsed_ = 0;
    waits_ = !excited_;  // before the first sample there is nothing to come from
    excited_ = true;
    if (to_.level.partials.silent()) return;
    if (!was_in_contact && !sounding()) phase_.forget();
    const double seconds_per_quantum = kQuantumFrames / options_.sample_rate_hz;
    phase_.set_target(next.phase_rad, next.phase_rate_rad_per_s * seconds_per_quantum, quanta, sounding());
}

void CuttingVoice::release() {
    to_.level = {};
    length_ = elapsed_ = 0;
}

CuttingVoice::Level CuttingVoice::next_level(const PhasePiece& phase) const {
    Level sum;
    if (asked_sounding_ == 0) return sum;
    for (std::size_t k = 0; k < bell_size_; ++k) {
        const Level& level = asked_[(newest_ + k) % bell_size_];
        sum.noise.body_pa += bell_[k] * level.noise.body_pa;
        sum.noise.chips_pa += bell_[k] * level.noise.chips_pa;
        sum.noise.coarse += bell_[k] * level.noise.coarse;
        sum.partials.count = std::max(sum.partials.count, level.partials.count);
        for (std::size_t n = 0; n < static_cast<std::size_t>(level.partials.count); ++n) {
            sum.partials.re[n] += bell_[k] * level.partials.re[n];
            sum.partials.im[n] += bell_[k] * level.partials.im[n];
        }
    }
    // It is played in this quantum and the next two: where the spindle runs up, by what it will be then.
    const double first = std::abs(phase.slope(0)), last = std::abs(phase.slope(kQuantumFrames));
    const double rad_per_frame = step_ * (last + 2 * std::max(last - first, 0.0));
    sum.partials = audible(sum.partials, rad_per_frame / math::kTwoPi * options_.sample_rate_hz,
                           options_.sample_rate_hz);
    return sum;
}

void CuttingVoice::add(Quantum& pressure_pa) {
    const PhasePiece phase = phase_.advance();
    const Excitation wanted = now();
    ++elapsed_;
    if (!sounding()) step_ = wanted.step;

    newest_ = (newest_ + bell_size_ - 1) % bell_size_;
    Level& asked = asked_[newest_];
    asked_sounding_ -= asked.silent() ? 0 : 1;
    asked = {wanted.step == step_ ? wanted.level.partials : Partials{}, wanted.level.noise};
    asked_sounding_ += asked.silent() ? 0 : 1;

    before_ = here_;
    here_ = after_;
    after_ = next_level(phase);
    const std::uint64_t quantum = quantum_++;
    Quantum sound{}, louder{};
    if (!before_.partials.silent() || !here_.partials.silent() || !after_.partials.silent()) {
        play(before_.partials, here_.partials, after_.partials, phase, step_, sound);
    }
    const bool noisy = before_.noisy() || here_.noisy() || after_.noisy();
    if (noisy) swing(sound, louder);
    const auto at = [](std::size_t n) { return static_cast<double>(n) * (1.0 / kQuantumFrames); };
    const Spline power(before_.noise.body_pa, here_.noise.body_pa, after_.noise.body_pa);
    if (noisy && options_.sound.sound_share > 0) {
        const auto pink = pink_.block(quantum);
        for (std::size_t j = 0; j < sound.size(); ++j) {
            sound[j] += pink_gain_ * power.at(at(j)) * louder[j] * pink[j];
        }
    }
    bool any = false;
    for (const double v : sound) any = any || v != 0;
    if (any) ringing_ = body_.ring_quanta();
    if (ringing_ > 0) {
        body_.apply(sound);
        for (std::size_t j = 0; j < sound.size(); ++j) pressure_pa[j] += options_.share * sound[j];
        if (--ringing_ == 0) body_.forget();
    }
    if (noisy && options_.sound.chips.sounds()) {
        const Spline level(before_.noise.chips_pa, here_.noise.chips_pa, after_.noise.chips_pa);
        Quantum chips;
        chips_.render(quantum, after_.noise.coarse, chips);
        for (std::size_t j = 0; j < chips.size(); ++j) {
            pressure_pa[j] += options_.share * level.at(at(j)) * louder[j] * chips[j];
        }
    }
}

void CuttingVoice::swing(const Quantum& tone, Quantum& out) const {
    const Spline peak(before_.partials.peak(), here_.partials.peak(), after_.partials.peak());
    for (std::size_t j = 0; j < out.size(); ++j) {
        const double highest = peak.at(static_cast<double>(j) * (1.0 / kQuantumFrames));
        out[j] = 1 + (highest > 0 ? kNoiseSwing * std::clamp(tone[j] / highest, -1.0, 1.0) : 0);
    }
}

}  // namespace tribo::sound
