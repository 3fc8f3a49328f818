// SPDX-License-Identifier: MIT
// The sound of a spindle that turns, whether it cuts or not.
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
    double share_in_cut = 1;  // of the pressure while the tool cuts: a recorded cut brings its own machine
};

// Lines and noise as SpindleSound says, by the speed that samples tell; a sample with a spectrum cuts. Lines
// follow the speed without a step of their phase, levels within 20 ms. Lines that the sample rate does not
// carry are left out. About 17 ns a frame, nothing where no spindle turns; no allocation after construction.
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
    double noise_gain_ = 0, line_gain_ = 0;  // of a level of 1
    Ramp rate_;                              // turns per frame
    Ramp cutting_;                           // 1: the tool cuts
    SmoothLevel level_;
    bool told_ = false;  // whether anybody says how it turns
    std::uint64_t quantum_ = 0;
    std::array<double, SpindleSound::kLines> turns_{};  // phase of each line
};

}  // namespace tribo::sound
