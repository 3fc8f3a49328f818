// SPDX-License-Identifier: MIT
#include "material/learned_material.hpp"

#include <cmath>

namespace tribo::material {
namespace {

double rounded(double value, double step) {
    return std::round(value / step) / std::round(1 / step);
}

// Rounds to the significant digits, so that files stay short and readable.
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

}  // namespace

Material learned_material(Material m, const noise::Learned& learned, const noise::LearningOptions& options,
                          const std::vector<RecordingSource>& recordings) {
    m.method = options.method == noise::Method::burg ? "burg" : "yule-walker";
    m.highpass_hz = options.highpass_hz;
    m.voices = learned.voices;
    round_digits(m.voices);
    m.sources.resize(m.voices.models.size());
    for (std::size_t n = 0; n < recordings.size(); ++n) {
        const noise::LearnedRecording& r = learned.recordings[n];
        RecordingSource source = recordings[n];
        source.seconds = rounded(r.seconds, 1e-3);
        source.peak_db = rounded(r.peak_db, 0.01);
        source.silent_share = rounded(r.silent_share, 1e-4);
        source.clipped_share = r.clipped_share;
        m.sources[static_cast<std::size_t>(r.model)].push_back(std::move(source));
    }
    return m;
}

}  // namespace tribo::material
