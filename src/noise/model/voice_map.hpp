// SPDX-License-Identifier: MIT
// Selects the models of a material for a speed and force, with their shares and level.
#pragma once

#include <array>
#include <vector>

#include "noise/model/material_voices.hpp"

namespace tribo::noise {

// Largest rise above the level of the loudest recording beyond the recorded speeds; the same again beyond the
// recorded forces.
inline constexpr double kMostAboveDb = 6;

// Up to four models: the two neighbouring speeds at each of the two neighbouring forces.
struct VoicePlace {
    int count = 0;
    std::array<int, 4> model{};     // ascending
    std::array<double, 4> share{};  // > 0, of the power, sum 1
    double gain = 0;                // RMS amplitude, full scale 1; 0: silence
};

// Construction allocates. The look-ups are real-time safe, on any thread.
class VoiceMap {
  public:
    // `voices`: at least one model; used during this call only.
    explicit VoiceMap(const MaterialVoices& voices);

    // Takes any finite speed and force; zero speed or zero force is silence. Between recordings, shares and
    // level (in dB) are linear in the logarithms. Beyond them the law holds: below, down to silence (at least
    // with the square root of speed and force); above, up to kMostAboveDb more.
    VoicePlace at(double speed_mm_per_s, double force_n) const;

    // As printed: shares linear in speed between the neighbours (amplitudes, not powers), and the linearly
    // interpolated mean power as the gain. At the ends only the last model is used. Force is ignored.
    VoicePlace as_published(double speed_mm_per_s) const;

  private:
    struct Knot {
        double log_speed = 0, speed = 0;
        double power = 0;      // mean square
        double offset_db = 0;  // level of the recording relative to the law
    };
    struct Row {  // the models of one force
        double log_force = 0;
        int first = 0, count = 0;
    };
    void add_row(const Row& row, double log_speed, double share, VoicePlace& place, double& offset_db) const;

    LevelLaw law_;
    std::vector<Knot> knots_;
    std::vector<Row> rows_;
    double slowest_ = 0, fastest_ = 0;  // log10
};

}  // namespace tribo::noise
