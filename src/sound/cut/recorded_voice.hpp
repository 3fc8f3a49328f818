// SPDX-License-Identifier: MIT
// A recording of a machine that follows the spindle.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/result.hpp"
#include "sound/cut/cutting_voice.hpp"
#include "sound/cut/spindle_phase.hpp"
#include "sound/cut/voice.hpp"
#include "sound/place/ear_kernels.hpp"
#include "sound/play/smooth_level.hpp"

namespace tribo::sound {

struct Recording {
    std::vector<float> samples;  // one channel, any level
    double sample_rate_hz = 0;
    double spindle_rpm = 0;  // at which it was recorded, even throughout
};

// The spindle may run at up to this many times the recorded speed; beyond, the voice keeps to it.
inline constexpr double kFastestPlay = 4;

// Refuses what cannot be looped: less than four turns, more than two minutes, silence, no rate or speed.
Result<void> check_recording(const Recording& recording);

struct RecordedVoiceOptions {
    double sample_rate_hz = 48000;
    double share = 1;  // of the pressure
    // Of an idle spindle: RMS pressure in Pa at 1 m whenever the spindle turns. 0: of a cut, as loud (RMS) as
    // CuttingVoice would be.
    double idle_pa = 0;
    CutSound cut{};  // of the CuttingVoice
};

// Order tracking: the recording is a loop of whole turns, read as fast as the spindle turns now over how fast
// it did, so its lines stay on the orders of the synthetic ones. The loop's seam is a crossfade of constant
// power whatever its two sides have in common. Below the recorded speed the recording's own band shrinks;
// above, copies low-passed an octave and two keep it under half the sample rate. Levels follow within 20 ms,
// without a step.
class RecordedVoice final : public Voice {
  public:
    // The recording is as check_recording() accepts it.
    RecordedVoice(const Recording& recording, const RecordedVoiceOptions& options);

    void excite(const contact::ContactSample& next, std::int64_t quanta) override;
    void release() override;
    void add(Quantum& pressure_pa) override;

    // Frames of the recording that are one turn and one loop.
    double frames_per_turn() const { return frames_per_turn_; }
    double loop_frames() const { return loop_frames_; }

  private:
    static constexpr int kCopies = 3;
    double read(const std::vector<float>& copy, double place) const;

    RecordedVoiceOptions options_;
    double frames_per_turn_ = 0, loop_frames_ = 0;
    std::array<std::vector<float>, kCopies> copies_;  // the loop, RMS 1, with some of its start at its end
    const InterpolatorTable* table_;
    BodyFilter body_;  // of which only the gain is asked

    Ramp rate_;   // turns per frame
    Ramp level_;  // Pa RMS
    double place_ = 0;
    SmoothLevel loudness_;
};

}  // namespace tribo::sound
