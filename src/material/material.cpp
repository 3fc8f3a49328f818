// SPDX-License-Identifier: MIT
#include "material/material.hpp"

#include <cmath>

namespace tribo::material {
namespace {

double rounded(double value, double step) {
    return std::round(value / step) / std::round(1 / step);
}

}  // namespace

void round_digits(noise::MaterialVoices& voices) {
    const auto all = [](std::vector<double>& values, double step) {
        for (double& v : values) v = rounded(v, step);
    };
    for (noise::VoiceModel& v : voices.models) {
        v.level_db = rounded(v.level_db, 1e-3);
        all(v.spectrum.reflection, 1e-8);
        if (v.bass) {
            v.bass->share = rounded(v.bass->share, 1e-6);
            all(v.bass->spectrum.reflection, 1e-8);
        }
        if (!v.texture) continue;
        for (std::vector<double>& table : v.texture->levels_db) all(table, 1e-2);
        v.texture->coherence = rounded(v.texture->coherence, 1e-4);
        all(v.texture->lengths_mm, 1e-5);
        all(v.texture->weights, 1e-5);
        v.texture->grains.per_mm = rounded(v.texture->grains.per_mm, 1e-6);
        v.texture->grains.share = rounded(v.texture->grains.share, 1e-5);
        v.texture->grains.scatter = rounded(v.texture->grains.scatter, 1e-4);
        all(v.texture->grains.sizes, 1e-4);
        all(v.texture->grains.shape, 1e-5);
    }
    voices.law.level_db = rounded(voices.law.level_db, 1e-3);
    voices.law.db_per_decade_speed = rounded(voices.law.db_per_decade_speed, 1e-3);
    voices.law.db_per_decade_force = rounded(voices.law.db_per_decade_force, 1e-3);
}

}  // namespace tribo::material
