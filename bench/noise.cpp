// SPDX-License-Identifier: MIT
// Learned voices: the all-pole filter of order 50 beside liquid-dsp's, three voices with their noise, a
// rubbed material, learning.
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "harness.hpp"
#include "noise/learn/learning.hpp"
#include "noise/play/friction_voice.hpp"
#include "noise/play/noise_kernels.hpp"

#ifdef TRIBO_LIQUID
#include <liquid/liquid.h>
#endif

namespace tribo::bench {
namespace {

constexpr int kOrder = 50, kBlock = 64, kBlocks = 4000;

noise::ArModel model_of_order_50(double shift) {
    noise::ArModel model{48000, std::vector<double>(kOrder)};
    for (std::size_t n = 0; n < kOrder; ++n) {
        const auto m = static_cast<double>(n);
        model.reflection[n] = (n % 2 == 0 ? -0.8 : 0.6) / (1 + 0.3 * m) * std::cos((0.7 + shift) * m);
    }
    return model;
}

double ns_per_sample(int repeats, double samples, const auto& work) {
    return median_of(repeats, [&] {
        const double start = thread_s();
        work();
        return 1e9 * (thread_s() - start) / samples;
    });
}

double filter_ns(const noise::NoiseKernels& kernels, int repeats) {
    const std::vector<double> exact = noise::predictor_of(model_of_order_50(0).reflection);
    const std::vector<float> predictor(exact.begin(), exact.end());
    std::vector<float> response(31), x(kBlock, 0.1F), y(kOrder + kBlock + 16);
    response[15] = 1;
    return ns_per_sample(repeats, 1.0 * kBlock * kBlocks, [&] {
        for (int n = 0; n < kBlocks; ++n) {
            std::copy_n(y.begin() + kBlock, kOrder, y.begin());
            kernels.all_pole(predictor.data(), kOrder, response.data(), 0.1F, x.data(), y.data() + kOrder,
                             kBlock);
            keep(y);
        }
    });
}

#ifdef TRIBO_LIQUID
double liquid_ns(int repeats) {
    const std::vector<double> exact = noise::predictor_of(model_of_order_50(0).reflection);
    std::vector<float> a{1}, b{0.1F};
    a.insert(a.end(), exact.begin(), exact.end());
    iirfilt_rrrf filter = iirfilt_rrrf_create(b.data(), 1, a.data(), static_cast<unsigned>(a.size()));
    std::vector<float> x(kBlock, 0.1F), y(kBlock);
    const double ns = ns_per_sample(repeats, 1.0 * kBlock * kBlocks / 10, [&] {
        for (int n = 0; n < kBlocks / 10; ++n) {
            iirfilt_rrrf_execute_block(filter, x.data(), kBlock, y.data());
            keep(y);
        }
    });
    iirfilt_rrrf_destroy(filter);
    return ns;
}
#endif

noise::MaterialVoices three_voices(bool textured) {
    noise::MaterialVoices voices;
    for (const double speed : {30.0, 100.0, 300.0}) {
        noise::VoiceModel m;
        m.speed_mm_per_s = speed;
        m.level_db = -40 + 14 * std::log10(speed / 30);
        m.spectrum = model_of_order_50(0.001 * speed);
        if (textured) {
            noise::TextureModel t;
            t.crossovers_hz = {400, 1500, 5000, 12000};
            std::vector<double> table;
            for (int n = 0; n < noise::kLevelSteps; ++n) table.push_back(1.5 * (n - 8));
            t.levels_db.assign(5, table);
            t.coherence = 0.8;
            t.lengths_mm = {0.01 * speed, 0.1 * speed};
            t.weights = {0.5, 0.5};
            normalize(t);
            m.texture = t;
        }
        voices.models.push_back(std::move(m));
    }
    voices.law = fit_level_law(voices.models);
    return voices;
}

double voice_ns(const noise::MaterialVoices& voices, const noise::FrictionOptions& options, double speed,
                int repeats) {
    noise::FrictionVoice voice(voices, options);
    std::vector<float> block(128);
    return ns_per_sample(repeats, 128.0 * kBlocks / 4, [&] {
        for (int n = 0; n < kBlocks / 4; ++n) {
            voice.set_target(speed + 0.001 * n * (speed > 0 ? 1 : 0), speed > 0 ? 1 : 0);
            voice.render(block);
            keep(block);
        }
    });
}

}  // namespace

void measure_noise(Report& report, int repeats) {
    report.section("Learned noise");
    const int times = 7 * repeats;
    std::optional<double> peer;
#ifdef TRIBO_LIQUID
    peer = liquid_ns(times);
#else
    report.note("liquid-dsp not found: no peer");
#endif
    const auto filter = [&](const char* name, const noise::NoiseKernels* kernels, double goal) {
        if (kernels == nullptr) return;
        report.add({name, filter_ns(*kernels, times), "ns per sample", goal, Better::lower,
                    peer ? "liquid-dsp" : "", peer});
    };
    filter("all-pole filter of order 50, x86-64-v3", noise::noise_kernels_v3(), 4);
    filter("all-pole filter of order 50, SSE2", noise::noise_kernels_sse2(), 6);
    noise::FrictionOptions published;
    published.as_published = true;
    report.add({"three voices with their noise", voice_ns(three_voices(false), published, 150, times),
                "ns per sample", 12});
    report.add({"rubbing: two of three voices, mixed", voice_ns(three_voices(false), {}, 150, times),
                "ns per sample"});
    noise::FrictionOptions lines;
    lines.interpolation = noise::Interpolation::line_spectrum;
    report.add({"rubbing: one voice of moving lines", voice_ns(three_voices(false), lines, 150, times),
                "ns per sample"});
    report.add({"rubbing: two of three textured voices", voice_ns(three_voices(true), {}, 150, times),
                "ns per sample"});
    report.add({"rubbing: silence", voice_ns(three_voices(true), {}, 0, times), "ns per sample"});

    noise::ModelNoise source(model_of_order_50(0), 5);
    noise::Recording recording{"bench", 100, 1, 48000, std::vector<double>(10 * 48000)};
    source.render(0, recording.samples);
    report.add({"learning from 10 s of sound",
                median_of(repeats,
                          [&] {
                              const double start = thread_s();
                              keep(noise::learn({&recording, 1}));
                              return thread_s() - start;
                          }),
                "s"});
}

}  // namespace tribo::bench
