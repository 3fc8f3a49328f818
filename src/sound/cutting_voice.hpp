// SPDX-License-Identifier: MIT
// The sound of a cutter in material: a force that repeats with the spindle, and chips that do not.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "noise/band_noise.hpp"
#include "noise/model_noise.hpp"
#include "sound/body.hpp"
#include "sound/partials.hpp"
#include "sound/spindle_phase.hpp"
#include "sound/voice.hpp"

namespace tribo::sound {

struct CuttingVoiceOptions {
    double sample_rate_hz = 48000;
    std::uint64_t seed = 1;       // of the chip noise
    noise::Band chip_band{};      // 1 to 8 kHz; unless
    noise::ArModel chip_model{};  // has poles: the colour of a recorded cut
    double share = 1;             // of the pressure
    Body body{};                  // what rings along
};

// Eq. 22 of the paper made to work: partials at the harmonics of the force spectrum (tooth passing and its
// multiples; the spindle's own with run-out), each kPascalPerNewton times the force's, in phase with the
// spindle angle that picture and arm are shown; plus noise with kPascalPerMm3PerS times feed x area (the
// paper's A2, linear), whose level swings by half with the partials, as chips come tooth by tooth.
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
    void drive(const Quantum& force_n) override;
    void add(Quantum& pressure_pa) override;

  private:
    struct Excitation {
        int step = 1;  // spindle orders per partial
        Partials partials;
        double noise_pa = 0;
    };
    struct Level {
        Partials partials;
        double noise_pa = 0;
        bool silent() const { return partials.silent() && noise_pa == 0; }
    };
    static constexpr std::size_t kMaxKernel = 40;

    Excitation now() const;
    // The bell over what was asked for, cut to what the sample rate carries.
    Level next_level(const PhasePiece& phase) const;
    bool sounding() const {
        return asked_sounding_ > 0 || !before_.silent() || !here_.silent() || !after_.silent();
    }
    void add_noise(const Quantum& tone, Quantum& pressure_pa);
    // Its share of the tone, crossfaded.
    void mix_driven(Quantum& tone);

    CuttingVoiceOptions options_;
    noise::BandNoise chips_;
    std::optional<noise::ModelNoise> model_chips_;
    BodyFilter body_;
    int ringing_ = 0;  // quanta for which the body is still heard
    // A force that came at audio rate: its tone, and how much of the sound it makes.
    Quantum driven_{};
    double drive_share_ = 0, drive_next_ = 0, force_before_ = 0, tone_before_ = 0;
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
    std::uint64_t frame_ = 0;
    bool chips_fresh_ = true;
};

}  // namespace tribo::sound
