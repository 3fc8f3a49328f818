// SPDX-License-Identifier: MIT
// Sound of a cutter in material: tones that repeat with the spindle, and noise.
#pragma once

#include <array>
#include <cstdint>

#include "noise/play/pink_noise.hpp"
#include "sound/cut/body.hpp"
#include "sound/cut/chip_noise.hpp"
#include "sound/cut/partials.hpp"
#include "sound/cut/spindle_phase.hpp"
#include "sound/cut/voice.hpp"

namespace tribo::sound {

// Sound of a cut in addition to the harmonics of its force.
struct CutSound {
    Body body{};             // resonances of machine and tool
    double sound_share = 0;  // share of the cutting power that becomes noise, through the body
    ChipOptions chips{};     // in the air, without the body
};

// RMS pressures at 1 m of the noise of a cut: through the body, and from the chips in the air. A learned
// spectrum contains both; chips_pa then has all of it.
struct CutNoise {
    double body_pa = 0, chips_pa = 0, coarse = 0;
};
CutNoise noise_of(const CutSound& sound, const contact::ContactSample& cut);

struct CuttingVoiceOptions {
    double sample_rate_hz = 48000;
    std::uint64_t seed = 1;  // of the noise
    double share = 1;        // of the pressure
    CutSound sound{};
};

// Eq. 22 of the paper, corrected. Partials stand at the harmonics of the force spectrum (tooth passing and
// its multiples; with run-out also the spindle's). Their amplitude is kPascalPerNewton times the force. Their
// phase follows the spindle angle of picture and arm. Pink noise follows the cutting power. Both go through
// the body. The noise of the chips is added (A2 of the paper). Half of the noise level is modulated by the
// partials, because chips break tooth by tooth.
//
// A step of an amplitude becomes a smooth S of 13 ms. Amplitudes lag 6.7 ms behind their excitation (at
// 48 kHz); the phase has no lag. The spindle angle of a sample without a spectrum is ignored. A spectrum with
// another order_step waits until the old one has faded.
// About 80 ns per frame with 32 partials and noise, nothing in silence. 50 KB, no allocation after
// construction.
class CuttingVoice final : public Voice {
  public:
    explicit CuttingVoice(const CuttingVoiceOptions& options = {});

    void excite(const contact::ContactSample& next, std::int64_t quanta) override;
    void release() override;
    void add(Quantum& pressure_pa) override;

  private:
    struct Level {
        Partials partials;
        CutNoise noise;
        bool noisy() const { return noise.body_pa > 0 || noise.chips_pa > 0; }
        bool silent() const { return partials.silent() && !noisy(); }
    };
    struct Excitation {
        int step = 1;  // spindle orders per partial
        Level level;
    };
    static constexpr std::size_t kMaxKernel = 40;

    Excitation now() const;
    // The requested levels, smoothed by the bell and limited to the sample rate.
    Level next_level(const PhasePiece& phase) const;
    bool sounding() const {
        return asked_sounding_ > 0 || !before_.silent() || !here_.silent() || !after_.silent();
    }
    // Gain of the noise in each frame, modulated by the teeth.
    void swing(const Quantum& tone, Quantum& out) const;

    CuttingVoiceOptions options_;
    noise::PinkNoise pink_;
    ChipNoise chips_;
    BodyFilter body_;
    double pink_gain_ = 0;  // gain of the body for pink noise of level 1
    int ringing_ = 0;       // quanta until the body is silent
    SpindlePhase phase_;
    Excitation from_, to_;
    std::int64_t length_ = 0, elapsed_ = 0;  // of the transition from from_ to to_, in quanta
    bool excited_ = false, waits_ = false;   // waits: stays at from_ until the end of the transition

    std::array<double, kMaxKernel> bell_{};  // sum 1
    std::size_t bell_size_ = 0;
    std::array<Level, kMaxKernel> asked_;  // per quantum, newest at newest_
    std::size_t newest_ = 0;
    std::size_t asked_sounding_ = 0;  // how many of asked_ are not silent
    int step_ = 1;                    // of asked_ and what is played
    Level before_, here_, after_;     // spline of the current quantum
    std::uint64_t quantum_ = 0;
};

}  // namespace tribo::sound
