// SPDX-License-Identifier: MIT
// A touchable material as plain data: how its image yields, and how it sounds when rubbed. These are the
// contents of a material file (docs/material.md); material_schema.hpp has the ranges.
#pragma once

#include <string>
#include <vector>

#include "noise/model/material_voices.hpp"

namespace tribo::material {

// Source of a voice: one recording and its measured values.
struct RecordingSource {
    std::string file;    // name as given
    double seconds = 0;  // of sound used for learning, without silence
    double sample_rate_hz = 0;
    int channels = 1, bits = 0;  // bits 0: not integers
    double peak_db = 0;          // dB of full scale, before the high-pass
    double silent_share = 0;     // of its time, 0 ... 1: not used
    double clipped_share = 0;    // of its samples, 0 ... 1

    friend bool operator==(const RecordingSource&, const RecordingSource&) = default;
};

struct Material {
    std::string name;
    std::string note;  // a remark for readers, for example that the material is synthetic

    double stiffness_n_per_mm = 4;      // K: force over indentation at the centre of the contact
    double viscosity_n_s_per_mm = 0.3;  // nu, >= 0
    double width_mm = 0;                // of the image, as touched; 0: not known
    std::string image;                  // relative to the material file; empty: none

    // Optical properties of the image (elastic/picture.hpp).
    std::string height_map;     // relative to the material file, size of the image; empty: its brightness
    double relief_slope = 0.2;  // RMS slope of the small relief, 0..1
    double gloss = 0.04;        // share of the light that is reflected like in a mirror, 0..1
    double roughness = 0.5;     // spread of this reflection, 0.05 (polished) .. 1 (matt)
    double pile = 0;            // slope of the hairs that a finger has brushed over, 0..1; 0: there are none

    // How the voices were learned.
    std::string method;      // "yule-walker" or "burg"; empty without voices
    double highpass_hz = 0;  // lower frequencies were removed

    noise::MaterialVoices voices;                       // may be empty
    std::vector<std::vector<RecordingSource>> sources;  // of each model, in the order of voices.models

    friend bool operator==(const Material&, const Material&) = default;
};

}  // namespace tribo::material
