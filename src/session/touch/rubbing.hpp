// SPDX-License-Identifier: MIT
// The friction sound of a stroke that is known from beginning to end.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "noise/play/friction_voice.hpp"
#include "readers/tables/stroke_csv.hpp"

namespace tribo::session {

// Speed and force along a stroke. Between two points the finger moves evenly; from one speed to the next it
// changes within kSpeedChangeS, or half of the shorter of the two stretches, on either side of the point.
// The same is true of the way into and out of contact.
inline constexpr double kSpeedChangeS = 0.01;

class StrokeMotion {
  public:
    // `points` rise in time and number at least two; borrowed.
    explicit StrokeMotion(std::span<const readers::FingerPoint> points);

    struct State {
        double speed_mm_per_s = 0, force_n = 0;
    };
    // Times may only rise from call to call. Outside the stroke: no contact. Real-time safe.
    State at(double t_s);

  private:
    double speed_of(std::size_t segment) const;
    double change_s(std::size_t point) const;

    std::span<const readers::FingerPoint> points_;
    std::size_t segment_ = 0;
};

// Renders from t = 0 on.
class Rubbing {
  public:
    Rubbing(const noise::MaterialVoices& voices, std::span<const readers::FingerPoint> points,
            const noise::FrictionOptions& options);

    // Frames until the stroke is over and its last sound has died.
    std::int64_t frames() const { return frames_; }
    void render(std::span<float> out);

  private:
    double sample_rate_hz_;
    StrokeMotion motion_;
    noise::FrictionVoice voice_;
    std::int64_t frames_ = 0;
};

}  // namespace tribo::session
