// SPDX-License-Identifier: MIT
// Sound of a cut that chatters.
#pragma once

#include <array>
#include <complex>
#include <cstdint>

#include "sound/cut/body.hpp"
#include "sound/cut/in_plane.hpp"
#include "sound/cut/voice.hpp"

namespace tribo::sound {

// A trace is heard so much later than it says: what ends with a sample of a contact is always known ahead.
inline constexpr double kVibrationDelayS = 0.004;

// Phase and delay with which a vibration is heard, as a factor of size 1: partials that sound beside it take
// it too. `rate_hz`: of the trace.
std::complex<double> vibration_response(double hz, double rate_hz);

struct VibrationVoiceOptions {
    double sample_rate_hz = 48000;
    double share = 1;  // of the pressure
    Body body{};       // resonances of machine and tool
};

// kPascalPerNewton times what a vibration adds to the force in the plane across the tool axis
// (contact::ForceTrace), through the body. The first and the last 3 ms fade. A trace may reach 60 ms ahead;
// what reaches farther is not heard. About 20 ns per frame, nothing in silence.
class VibrationVoice final : public Voice {
  public:
    explicit VibrationVoice(const VibrationVoiceOptions& options = {});

    void excite(const contact::ContactSample& next, std::int64_t quanta) override;
    void release() override;
    void add(Quantum& pressure_pa) override;

  private:
    static constexpr std::size_t kKept = 4096;  // values; a power of two

    void keep(const contact::ForceTrace& trace);
    void append(const std::array<double, 2>& force_n);
    double& value(std::int64_t index) { return kept_[static_cast<std::size_t>(index) & (kKept - 1)]; }
    // The next frame, in samples of the trace.
    double heard_index() const;
    // The trace between its samples, 0 outside.
    double value_at(double index);

    VibrationVoiceOptions options_;
    InPlane in_plane_;
    BodyFilter body_;
    int ringing_ = 0;  // quanta until the body is silent
    std::array<double, kKept> kept_{};
    double rate_hz_ = 48000;  // of the trace
    // The first sample of this stretch of traces; of those that are kept; after the last one.
    std::int64_t begin_ = 0, first_ = 0, end_ = 0;
    std::array<double, 2> last_n_{};
    std::int64_t frame_ = 0;  // next frame
};

}  // namespace tribo::sound
