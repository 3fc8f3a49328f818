// SPDX-License-Identifier: MIT
// The sound of a cutter in material: a force that repeats with the spindle, and chips that do not.
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

// What a cut sounds of besides its force.
struct CutSound {
    Body body{};             // what becomes of the force: machine and tool
    double sound_share = 0;  // of the cutting power that becomes noise, through the body
    ChipOptions chips{};     // in the air, past the body
};

// RMS pressures at 1 m of the noise of a cut: what comes through the body, and what the chips make in the
// air. A learned colour knows both: the chips have all of it.
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

// Eq. 22 of the paper made to work: partials at the harmonics of the force spectrum (tooth passing and its
// multiples; the spindle's own with run-out), each kPascalPerNewton times the force's, in phase with the
// spindle angle that picture and arm are shown; pink noise by the cutting power; both through the body.
// Plus the noise of the chips (the paper's A2). Noise swings by half with the partials, as chips come tooth
// by tooth.
//
// An amplitude that steps takes 13 ms along a smooth S, and amplitudes stay 6.7 ms behind their excitation
// (at 48 kHz); the phase does not. Samples without a spectrum need not know the spindle: theirs is
// not listened to. A spectrum with another order_step waits until the old one has faded.
// About 80 ns a frame with 32 partials and noise, nothing in silence; 50 KB, no allocation after
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
    // The bell over what was asked for, cut to what the sample rate carries.
    Level next_level(const PhasePiece& phase) const;
    bool sounding() const {
        return asked_sounding_ > 0 || !before_.silent() || !here_.silent() || !after_.silent();
    }
    // How much louder noise is in each frame, as the teeth come and go.
    void swing(const Quantum& tone, Quantum& out) const;

    CuttingVoiceOptions options_;
    noise::PinkNoise pink_;
    ChipNoise chips_;
    BodyFilter body_;
    double pink_gain_ = 0;  // that the body makes a level of 1 of
    int ringing_ = 0;       // quanta for which the body is still heard
    SpindlePhase phase_;
    Excitation from_, to_;
    std::int64_t length_ = 0, elapsed_ = 0;  // of the way from one to the other, quanta
    bool excited_ = false, waits_ = false;   // waits: stays at from_ until the end of the way

    std::array<double, kMaxKernel> bell_{};  // sum 1
    std::size_t bell_size_ = 0;
    std::array<Level, kMaxKernel> asked_;  // per quantum, newest at newest_
    std::size_t newest_ = 0;
    std::size_t asked_sounding_ = 0;  // how many of asked_ are not silent
    int step_ = 1;                    // of asked_ and what is played
    Level before_, here_, after_;     // the spline of the quantum in hand
    std::uint64_t quantum_ = 0;
};

}  // namespace tribo::sound
