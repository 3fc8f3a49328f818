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
    double spindle_rpm = 0;  // constant speed during the recording
};

// Largest ratio of spindle speed to recorded speed. Faster spindles sound as at this ratio.
inline constexpr double kFastestPlay = 4;

// Refuses recordings that cannot be looped: less than four turns, more than two minutes, silence, no sample
// rate or no speed.
Result<void> check_recording(const Recording& recording);

struct RecordedVoiceOptions {
    double sample_rate_hz = 48000;
    double share = 1;  // of the pressure
    // > 0: recording of an idle spindle, with this RMS pressure in Pa at 1 m while the spindle turns. 0:
    // recording of a cut, with the RMS level of CuttingVoice.
    double idle_pa = 0;
    CutSound cut{};  // of the CuttingVoice
};

// Order tracking: the recording is a loop of whole turns. The read rate is the ratio of current to recorded
// speed, so its lines have the same orders as the synthetic ones. The seam of the loop is a crossfade with
// constant power for any correlation of its sides. Below the recorded speed the bandwidth shrinks. Above it,
// copies that are low-passed by one and by two octaves avoid aliasing. Levels follow within 20 ms, without a
// step.
class RecordedVoice final : public Voice {
  public:
    // check_recording() must accept the recording.
    RecordedVoice(const Recording& recording, const RecordedVoiceOptions& options);

    void excite(const contact::ContactSample& next, std::int64_t quanta) override;
    void release() override;
    void add(Quantum& pressure_pa) override;

    // Frames of one turn and of one loop.
    double frames_per_turn() const { return frames_per_turn_; }
    double loop_frames() const { return loop_frames_; }

  private:
    static constexpr int kCopies = 3;
    double read(const std::vector<float>& copy, double place) const;

    RecordedVoiceOptions options_;
    double frames_per_turn_ = 0, loop_frames_ = 0;
    std::array<std::vector<float>, kCopies> copies_;  // the loop, RMS 1, with some of its start at its end
    const InterpolatorTable* table_;
    BodyFilter body_;  // only its gain is used

    Ramp rate_;   // turns per frame
    Ramp level_;  // Pa RMS
    double place_ = 0;
    SmoothLevel loudness_;
};

}  // namespace tribo::sound
