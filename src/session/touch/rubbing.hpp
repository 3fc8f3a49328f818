// SPDX-License-Identifier: MIT
// Friction sound of a complete stroke.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "noise/play/friction_voice.hpp"
#include "readers/tables/stroke_csv.hpp"

namespace tribo::session {

// Speed and force along a stroke. The speed is constant between two points. Around a point it changes over
// kSpeedChangeS on either side, or over half of the shorter neighbouring interval. The same holds at the
// start and at the end of contact.
inline constexpr double kSpeedChangeS = 0.01;

class StrokeMotion {
  public:
    // `points`: at least two, with rising times; must outlive this object.
    explicit StrokeMotion(std::span<const readers::FingerPoint> points);

    struct State {
        double speed_mm_per_s = 0, force_n = 0;
    };
    // Times must not fall from call to call. No contact outside of the stroke. Real-time safe.
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

    // Length in frames: the stroke and the decay of the sound.
    std::int64_t frames() const { return frames_; }
    void render(std::span<float> out);

  private:
    double sample_rate_hz_;
    StrokeMotion motion_;
    noise::FrictionVoice voice_;
    std::int64_t frames_ = 0;
};

}  // namespace tribo::session
