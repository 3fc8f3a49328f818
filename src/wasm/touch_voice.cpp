// SPDX-License-Identifier: MIT
// The C ABI of touch.wasm, the AudioWorklet's side: a friction voice. Handles come from voice_create and end
// with voice_destroy.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "noise/play/friction_voice.hpp"

#define TRIBO_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace {

using namespace tribo::noise;

// Takes numbers one after the other, each within its range; the first that is missing or out of it makes the
// whole wrong.
class Numbers {
  public:
    Numbers(const double* values, std::uint32_t length) : values_(values), left_(length) {}

    double next(double least, double most) {
        const double value = good_ && left_ > 0 ? *values_ : least - 1;
        if (good_ && left_ > 0) {
            ++values_;
            --left_;
        }
        good_ = good_ && value >= least && value <= most;
        return good_ ? value : least;
    }
    int count(int most) { return static_cast<int>(next(0, most)); }
    std::vector<double> list(int length, double least, double most) {
        std::vector<double> values;
        for (int i = 0; good_ && i < length; ++i) values.push_back(next(least, most));
        return values;
    }
    void expect(bool holds) { good_ = good_ && holds; }
    bool good() const { return good_; }

  private:
    const double* values_;
    std::uint32_t left_;
    bool good_ = true;
};

TextureModel texture(Numbers& numbers, int bands, double rate_hz) {
    TextureModel t;
    t.crossovers_hz = numbers.list(bands - 1, 1e-3, 0.5 * rate_hz);
    for (int b = 0; b < bands; ++b) t.levels_db.push_back(numbers.list(kLevelSteps, -300, 100));
    t.coherence = numbers.next(0, 1);
    const int lengths = numbers.count(kMostLengths);
    t.lengths_mm = numbers.list(lengths, 1e-9, 1e6);
    t.weights = numbers.list(lengths, 0, 1);
    t.grains.per_mm = numbers.next(0, 1e4);
    t.grains.share = numbers.next(0, 1);
    t.grains.scatter = numbers.next(0, 1);
    t.grains.sizes = numbers.list(numbers.count(kMostGrainSizes), -1e4, 1e4);
    t.grains.shape = numbers.list(numbers.count(kLongestGrain), -1, 1);
    numbers.expect(std::is_sorted(t.crossovers_hz.begin(), t.crossovers_hz.end()) &&
                   std::is_sorted(t.grains.sizes.begin(), t.grains.sizes.end()));
    return t;
}

VoiceModel model(Numbers& numbers) {
    VoiceModel m;
    m.speed_mm_per_s = numbers.next(1e-6, 1e6);
    m.force_n = numbers.next(1e-6, 1e4);
    m.level_db = numbers.next(-300, 100);
    m.spectrum.sample_rate_hz = numbers.next(1000, 384000);
    m.spectrum.reflection =
        numbers.list(numbers.count(kLargestOrder), -kLargestReflection, kLargestReflection);
    const int bands = numbers.count(kMostBands);
    if (numbers.good() && bands > 0) m.texture = texture(numbers, bands, m.spectrum.sample_rate_hz);
    return m;
}

}  // namespace

// A voice from numbers: how many models; level in dB at 100 mm/s and 1 N and its two slopes; then of each
// model, ascending by force, then speed: speed, force, level in dB, sample rate, how many reflection
// coefficients and they, how many bands its texture has, 0: none. Of a texture: crossovers, 17 levels a band,
// coherence, how many lengths, they and their weights; of its grains number per mm, share, scatter, how many
// sizes and they, how many samples of a grain and they. Ranges are those of a material file. Null where the
// numbers are no voice.
TRIBO_EXPORT(voice_create)
FrictionVoice* voice_create(const double* values, std::uint32_t length, double sample_rate_hz,
                            std::uint32_t seed, std::uint32_t as_published) {
    Numbers numbers(values, length);
    MaterialVoices voices;
    const int models = numbers.count(64);
    numbers.expect(models > 0 && sample_rate_hz >= 1000 && sample_rate_hz <= 192000);
    voices.law.level_db = numbers.next(-300, 300);
    voices.law.db_per_decade_speed = numbers.next(-200, 200);
    voices.law.db_per_decade_force = numbers.next(-200, 200);
    for (int i = 0; numbers.good() && i < models; ++i) {
        VoiceModel m = model(numbers);
        if (i > 0) {
            const VoiceModel& before = voices.models.back();
            numbers.expect(m.force_n > before.force_n ||
                           (m.force_n == before.force_n && m.speed_mm_per_s > before.speed_mm_per_s));
        }
        voices.models.push_back(std::move(m));
    }
    if (!numbers.good()) return nullptr;
    FrictionOptions options;
    options.sample_rate_hz = sample_rate_hz;
    options.seed = seed;
    options.as_published = as_published != 0;
    return new FrictionVoice(voices, options);
}

TRIBO_EXPORT(voice_destroy) void voice_destroy(FrictionVoice* voice) {
    delete voice;
}
TRIBO_EXPORT(voice_set_target)
void voice_set_target(FrictionVoice* voice, double speed_mm_per_s, double force_n) {
    voice->set_target(speed_mm_per_s, force_n);
}
TRIBO_EXPORT(voice_render) void voice_render(FrictionVoice* voice, float* out, std::uint32_t frames) {
    voice->render({out, frames});
}
// RMS, full scale 1, that the present speed and force lead to.
TRIBO_EXPORT(voice_gain) double voice_gain(const FrictionVoice* voice) {
    return voice->target_gain();
}
