// SPDX-License-Identifier: MIT
// Vibration that rides on a contact: what is too fine to be geometry.
#pragma once

#include <cstdint>

#include "noise/play/band_noise.hpp"
#include "noise/play/friction_voice.hpp"

namespace tribo::haptics {

// A source of vibration at the servo's rate. Real-time safe; one thread.
class Vibration {
  public:
    virtual ~Vibration() = default;
    // The next tick's force along the normal, N, while the probe rubs at this speed (>= 0) and is pressed
    // with this force (>= 0); about 0 at rest or without contact.
    virtual double next(double speed_mm_per_s, double press_n) noexcept = 0;
};

// Plain noise between two frequencies, in proportion to the force pressed, rising with speed to full at
// `full_speed_mm_per_s`. Until something was learned.
class BandVibration final : public Vibration {
  public:
    struct Options {
        double share = 0.02;               // RMS of the vibration over the force pressed
        double full_speed_mm_per_s = 100;  // > 0
        noise::Band band{40, 400};         // the band of fingertips; below half the rate
        std::uint64_t seed = 1;
    };
    BandVibration(double rate_hz, const Options& options);
    double next(double speed_mm_per_s, double press_n) noexcept override;

  private:
    Options options_;
    noise::BandNoise noise_;
    std::uint64_t tick_ = 0;
};

// A voice learned from recordings of the material, played at the servo's rate: its level is a share of the
// force pressed.
class LearnedVibration final : public Vibration {
  public:
    // `newton_per_full_scale`: what the voice's full scale means to the hand.
    LearnedVibration(const noise::MaterialVoices& voices, double rate_hz, double newton_per_full_scale,
                     std::uint64_t seed = 1);
    double next(double speed_mm_per_s, double press_n) noexcept override;

  private:
    noise::FrictionVoice voice_;
    double scale_;
};

}  // namespace tribo::haptics
