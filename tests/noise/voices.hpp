// SPDX-License-Identifier: MIT
// Made-up voices and measures that several tests use.
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <utility>
#include <vector>

#include "noise/model/material_voices.hpp"

namespace tribo::noise::test {

// Three speeds at 1 N whose levels follow a power law exactly: RMS = 0.05 (v / 100)^0.7.
inline MaterialVoices three_speeds(double rate_hz = 48000) {
    MaterialVoices voices;
    for (const double speed : {30.0, 100.0, 300.0}) {
        VoiceModel m;
        m.speed_mm_per_s = speed;
        m.level_db = 20 * std::log10(0.05) + 14 * std::log10(speed / 100);
        m.spectrum = {rate_hz, {-0.7 + 0.001 * speed, 0.4, -0.2, 0.1}};
        voices.models.push_back(m);
    }
    voices.law = fit_level_law(voices.models);
    return voices;
}

// All-pole noise of pairs of poles at these frequencies and radii.
inline ArModel with_poles(double rate_hz, std::initializer_list<std::pair<double, double>> poles) {
    std::vector<double> a{1};
    for (const auto& [hz, r] : poles) {
        const double b = -2 * r * std::cos(2 * std::numbers::pi * hz / rate_hz), c = r * r;
        std::vector<double> next(a.size() + 2);
        for (std::size_t n = 0; n < a.size(); ++n) {
            next[n] += a[n];
            next[n + 1] += b * a[n];
            next[n + 2] += c * a[n];
        }
        a = next;
    }
    a.erase(a.begin());
    ArModel model{rate_hz, std::vector<double>(a.size())};
    reflection_of(a, model.reflection);
    return model;
}

inline double rms(const std::vector<float>& x) {
    double sum = 0;
    for (const float v : x) sum += static_cast<double>(v) * v;
    return std::sqrt(sum / static_cast<double>(x.size()));
}

inline double db(double ratio) {
    return 20 * std::log10(ratio);
}

}  // namespace tribo::noise::test
