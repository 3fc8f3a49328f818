// SPDX-License-Identifier: MIT
// A touchable material as plain data: how its image yields and how rubbing it sounds. What a material file
// (docs/material.md) carries; material_schema.hpp has the ranges.
#pragma once

#include <string>
#include <vector>

#include "noise/model/material_voices.hpp"

namespace tribo::material {

// Where a voice comes from: one recording, and what was found about it.
struct RecordingSource {
    std::string file;    // as it was named
    double seconds = 0;  // of sound that was learned from, silence left out
    double sample_rate_hz = 0;
    int channels = 1, bits = 0;  // bits 0: not integers
    double peak_db = 0;          // dB of full scale, before the high-pass
    double silent_share = 0;     // of its time, 0 ... 1: left out
    double clipped_share = 0;    // of its samples, 0 ... 1

    friend bool operator==(const RecordingSource&, const RecordingSource&) = default;
};

struct Material {
    std::string name;
    std::string note;  // anything a reader should know, such as that it is synthetic

    double stiffness_n_per_mm = 4;      // K: force over indentation at the contact's centre
    double viscosity_n_s_per_mm = 0.3;  // nu, >= 0
    double width_mm = 0;                // of the image as the finger feels it; 0: not known
    std::string image;                  // relative to the material file; empty: none

    // How the image takes the light (elastic/picture.hpp).
    std::string height_map;     // relative to the material file, as large as the image; empty: its brightness
    double relief_slope = 0.2;  // root mean square slope of the small relief, 0..1
    double gloss = 0.04;        // share of the light that is mirrored, 0..1
    double roughness = 0.5;     // what spreads it, 0.05 (polished) .. 1 (matt)

    // How the voices were learned.
    std::string method;      // "yule-walker" or "burg"; empty without voices
    double highpass_hz = 0;  // sound below was removed

    noise::MaterialVoices voices;                       // may be empty
    std::vector<std::vector<RecordingSource>> sources;  // of each model, in the order of voices.models

    friend bool operator==(const Material&, const Material&) = default;
};

}  // namespace tribo::material
