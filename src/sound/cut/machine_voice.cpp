// SPDX-License-Identifier: MIT
#include "sound/cut/machine_voice.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "sound/cut/partials.hpp"

namespace tribo::sound {
namespace {

// A spindle as slow as this share of its usual speed is not heard.
constexpr double kLeastSpeed = 1e-3;
// Beyond this many times its usual speed it gets no louder.
constexpr double kLoudestSpeed = 4;

}  // namespace

MachineVoice::MachineVoice(const MachineVoiceOptions& options)
    : options_(options), pink_(options.seed, options.sample_rate_hz) {
    const SpindleSound& spindle = options.spindle;
    housing_.set(spindle.housing, options.sample_rate_hz);
    const double pink = housing_.gain_of_pink();
    noise_gain_ = pink > 0 ? std::sqrt(1 - spindle.tonal) / pink : 0;
    double power = 0;
    for (const SpindleLine& line : spindle.lines) power += 0.5 * line.level * line.level;
    line_gain_ = power > 0 ? std::sqrt(spindle.tonal / power) : 0;
}

void MachineVoice::excite(const contact::ContactSample& next, std::int64_t quanta) {
    rate_.set_target(std::abs(next.phase_rate_rad_per_s) / math::kTwoPi / options_.sample_rate_hz, quanta);
    cutting_.set_target(next.spectrum != nullptr && !next.spectrum->empty() ? 1 : 0, quanta);
    // A spindle that nobody hears is at its speed.
    if (level_.over()) rate_.jump_to(rate_.target());
    has_speed_ = true;
}

void MachineVoice::release() {
    has_speed_ = false;  // it dies away at its speed
    rate_.jump_to(rate_.target());
}

void MachineVoice::add_lines(double turns_per_frame, Quantum& sound) {
    // x[n] = 2 cos(w) x[n - 1] - x[n - 2], begun anew in every quantum, all lines side by side.
    std::array<double, SpindleSound::kLines> two_cosines{}, x{}, before{};
    for (std::size_t k = 0; k < x.size(); ++k) {
        const SpindleLine& line = options_.spindle.lines[k];
        const double step = line.order * turns_per_frame;
        const double level =
            line_gain_ * line.level * audible_share(step * options_.sample_rate_hz, options_.sample_rate_hz);
        double sine, cosine, step_sine, step_cosine;
        math::sincos(math::kTwoPi * turns_[k], sine, cosine);
        math::sincos(math::kTwoPi * step, step_sine, step_cosine);
        two_cosines[k] = 2 * step_cosine;
        x[k] = level * sine;
        before[k] = level * (sine * step_cosine - cosine * step_sine);
        turns_[k] += kQuantumFrames * step;
        turns_[k] -= std::floor(turns_[k]);
    }
    for (double& v : sound) {
        v += ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
        for (std::size_t k = 0; k < x.size(); ++k) {
            const double next = two_cosines[k] * x[k] - before[k];
            before[k] = x[k];
            x[k] = next;
        }
    }
}

void MachineVoice::add(Quantum& pressure_pa) {
    const double rate = rate_.advance();
    const double speed = rate * 60 * options_.sample_rate_hz / options_.spindle.rpm;
    const double share = 1 + cutting_.advance() * (options_.share_in_cut - 1);
    const bool turns = has_speed_ && speed > kLeastSpeed;
    level_.follow(turns ? share * options_.spindle.pa *
                              math::pow(std::min(speed, kLoudestSpeed), options_.spindle.exponent)
                        : 0);
    const std::uint64_t quantum = quantum_++;
    if (level_.silent()) return;

    Quantum sound;
    const auto pink = pink_.block(quantum);
    for (std::size_t n = 0; n < sound.size(); ++n) sound[n] = noise_gain_ * pink[n];
    housing_.apply(sound);
    add_lines(rate, sound);
    const Spline loud = level_.spline();
    for (std::size_t n = 0; n < sound.size(); ++n) {
        pressure_pa[n] += loud.at(static_cast<double>(n) * (1.0 / kQuantumFrames)) * sound[n];
    }
}

}  // namespace tribo::sound
