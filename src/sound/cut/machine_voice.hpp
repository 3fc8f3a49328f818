// SPDX-License-Identifier: MIT
// Sound of the turning spindle, in a cut and in air.
#pragma once

#include <array>
#include <cstdint>

#include "noise/play/pink_noise.hpp"
#include "sound/cut/body.hpp"
#include "sound/cut/machine.hpp"
#include "sound/cut/voice.hpp"
#include "sound/play/smooth_level.hpp"

namespace tribo::sound {

struct MachineVoiceOptions {
    double sample_rate_hz = 48000;
    std::uint64_t seed = 1;  // of the noise
    SpindleSound spindle{};
    double share_in_cut = 1;  // of the pressure during a cut: a recorded cut already contains the machine
};

// Lines and noise of a SpindleSound at the speed of the samples. A sample with a spectrum counts as a cut.
// Lines follow the speed without a phase step; levels follow within 20 ms. Lines above the sample rate limit
// are left out. About 17 ns per frame, nothing while the spindle stands. No allocation after construction.
class MachineVoice final : public Voice {
  public:
    explicit MachineVoice(const MachineVoiceOptions& options);

    void excite(const contact::ContactSample& next, std::int64_t quanta) override;
    void release() override;
    void add(Quantum& pressure_pa) override;

  private:
    void add_lines(double turns_per_frame, Quantum& sound);

    MachineVoiceOptions options_;
    noise::PinkNoise pink_;
    BodyFilter housing_;
    double noise_gain_ = 0, line_gain_ = 0;  // for a level of 1
    Ramp rate_;                              // turns per frame
    Ramp cutting_;                           // 1: the tool cuts
    SmoothLevel level_;
    bool has_speed_ = false;  // whether the spindle speed is known
    std::uint64_t quantum_ = 0;
    std::array<double, SpindleSound::kLines> turns_{};  // phase of each line
};

}  // namespace tribo::sound
