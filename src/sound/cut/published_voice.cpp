// SPDX-License-Identifier: MIT
#include "sound/cut/published_voice.hpp"

#include "base/math.hpp"
#include "sound/play/calibration.hpp"

namespace tribo::sound {
namespace {

// The paper's A2 per mm^3 of material removed in a second; its term is silent as printed.
constexpr double kPascalPerMm3PerS = 2e-4;

}  // namespace

double published_sound(double t_s, double a1, double f1_hz, double a2) {
    constexpr double kF2 = 0, kTheta1 = 0, kTheta2 = 0;
    return a1 * math::sin(math::kTwoPi * f1_hz * t_s + kTheta1) +
           a2 * math::sin(math::kTwoPi * kF2 * t_s + kTheta2);
}

void PublishedVoice::excite(const contact::ContactSample& next, std::int64_t quanta) {
    if (until_next_ == 0) now_ = next_;
    next_ = {kPascalPerNewton * length(next.force_n), next.phase_rate_rad_per_s / math::kTwoPi,
             kPascalPerMm3PerS * next.removed_mm3_per_s};
    until_next_ = quanta;
}

void PublishedVoice::release() {
    next_ = {};
    until_next_ = 0;
}

void PublishedVoice::add(Quantum& pressure_pa) {
    if (until_next_ == 0) {
        now_ = next_;
    } else {
        --until_next_;
    }
    for (double& p : pressure_pa) {
        const double t_s = static_cast<double>(frame_++) / sample_rate_hz_;
        p += published_sound(t_s, now_.a1, now_.f1_hz, now_.a2);
    }
}

}  // namespace tribo::sound
