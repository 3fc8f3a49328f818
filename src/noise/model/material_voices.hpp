// SPDX-License-Identifier: MIT
// What is known of a material's friction sound: one model for each speed (and force) at which it was
// recorded, and the law by which its level follows them. This is what `tribo learn` finds, a material file
// carries and FrictionVoice plays. Plain data.
#pragma once

#include <optional>
#include <vector>

#include "noise/model/ar_model.hpp"
#include "noise/model/texture_model.hpp"
#include "noise/play/bass_noise.hpp"

namespace tribo::noise {

// The sound at one speed and force.
struct VoiceModel {
    double speed_mm_per_s = 0;  // > 0
    double force_n = 1;         // > 0
    double level_db = 0;        // RMS, dB of full scale
    ArModel spectrum;
    std::optional<TextureModel> texture{};  // absent: Gaussian noise of that spectrum
    std::optional<BassModel> bass{};        // absent: the spectrum tells enough of it

    friend bool operator==(const VoiceModel&, const VoiceModel&) = default;
};

// Level in dB, linear in the logarithms of speed and force: the line that fits the recordings best. Between
// them the recordings themselves are followed; the law leads on beyond them.
struct LevelLaw {
    double level_db = 0;  // at 100 mm/s and 1 N
    // Friction noise grows about with the square root of friction power, force times speed (van den Doel,
    // Kry, Pai 2001): 10 dB a decade. This stands where recordings at one speed or one force tell nothing.
    double db_per_decade_speed = 10;
    double db_per_decade_force = 10;

    friend bool operator==(const LevelLaw&, const LevelLaw&) = default;
};
inline constexpr double kLawSpeedMmPerS = 100;
inline constexpr double kLawForceN = 1;

struct MaterialVoices {
    std::vector<VoiceModel> models;  // ascending by force, then speed; no two alike in both
    LevelLaw law;

    friend bool operator==(const MaterialVoices&, const MaterialVoices&) = default;
};

// A law is no steeper, and its level lies within this range.
inline constexpr double kSteepestLawDb = 200, kLeastLawDb = -200, kMostLawDb = 60;

// The law that fits the levels of the models best (least squares), within those bounds.
LevelLaw fit_level_law(const std::vector<VoiceModel>& models);

}  // namespace tribo::noise
