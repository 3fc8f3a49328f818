// SPDX-License-Identifier: MIT
// Eq. 23 of the paper as printed, for --as-published.
#pragma once

#include <cstdint>

#include "sound/cut/voice.hpp"

namespace tribo::sound {

// x(t) = A1 sin(2 pi F1 t + theta1) + A2 sin(2 pi F2 t + theta2) with F2 = theta1 = theta2 = 0 as the paper
// sets them: the second sine is zero at any A2. The paper feeds A1 the cutting force, F1 the spindle speed in
// turns per second and A2 feed x cutter area x a scalar.
double published_sound(double t_s, double a1, double f1_hz, double a2);

// The equation along a cut. Each cutter position holds until the next one. As printed, a change of the
// spindle speed makes the phase jump, and the tooth passing frequency is missing. A1 is the size of the force
// of the sample, scaled like all sound of this room.
class PublishedVoice final : public Voice {
  public:
    explicit PublishedVoice(double sample_rate_hz) : sample_rate_hz_(sample_rate_hz) {}

    void excite(const contact::ContactSample& next, std::int64_t quanta) override;
    void release() override;
    void add(Quantum& pressure_pa) override;

  private:
    struct Terms {
        double a1 = 0, f1_hz = 0, a2 = 0;
    };
    double sample_rate_hz_;
    Terms now_, next_;
    std::int64_t until_next_ = 0;  // quanta
    std::int64_t frame_ = 0;
};

}  // namespace tribo::sound
