// SPDX-License-Identifier: MIT
// The sound of rubbing a material: noise of the models learned nearest to the speed and force of the finger,
// mixed with equal power, at the level that the recordings had.
//
//     FrictionVoice voice(material.voices, {.sample_rate_hz = 48000});
//     voice.set_target(120, 0.8);        // mm/s, N: whenever they are known
//     voice.render(block);               // in the audio callback
//
// Speed and force are taken up at the next quantum (1.33 ms) and smoothed by a millisecond; steps of either
// are free of clicks. The output depends on seed, targets and the frames at which they came, never on block
// lengths.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "noise/model/material_voices.hpp"
#include "noise/model/voice_map.hpp"
#include "noise/play/model_noise.hpp"

namespace tribo::noise {

// Between two recordings.
enum class Interpolation {
    mix,           // both models sound, with equal power
    line_spectrum  // one model, its line spectral frequencies between those of the two: peaks move
};

struct FrictionOptions {
    double sample_rate_hz = 48000;  // 1000 ... 192000: a servo's rate gives vibration in place of sound
    std::uint64_t seed = 1;
    Interpolation interpolation = Interpolation::mix;
    // Without the textures: coloured Gaussian noise, for comparison.
    bool gaussian = false;
    // Frames between two looks at the targets: 1, 2, 4 ... 64; 0: what is nearest to 1.33 ms.
    int quantum_frames = 0;
    // The paper's generation step as printed: all models always run, amplitudes are mixed linearly (3 dB too
    // low half way), mean power serves as gain, nothing is smoothed, a finger at rest is heard.
    bool as_published = false;
};

// Construction allocates; everything else is real-time safe. One thread at a time.
class FrictionVoice {
  public:
    // `voices`: at least one model; copied.
    explicit FrictionVoice(const MaterialVoices& voices, const FrictionOptions& options = {});

    // Finger speed along the surface (its size) and force into it; 0 or less of either, or what is not a
    // number: silence.
    void set_target(double speed_mm_per_s, double force_n);

    // The next frames, mono, full scale 1 (never beyond: the ends are clipped). Replaces what `out` holds.
    void render(std::span<float> out);

    // Goes to a frame of the stream and to silence; the same targets then give the same samples again.
    void seek(std::uint64_t frame);
    std::uint64_t frame() const { return frame_; }

    // RMS level that the present target leads to, full scale 1.
    double target_gain() const;

  private:
    void next_quantum();
    void smooth_targets();
    void mix_models(const VoicePlace& place);
    void move_lines(const VoicePlace& place);
    void add(ModelNoise& noise, float from, float to);

    FrictionOptions options_;
    VoiceMap map_;
    std::vector<ModelNoise> noises_;
    std::vector<float> gain_, next_gain_;  // of each model, now and at the end of the quantum
    // For Interpolation::line_spectrum: the one model that sounds, at the end of noises_, and its angles.
    std::vector<std::vector<double>> lines_;
    std::vector<double> line_, predictor_, reflection_, line_work_;
    std::vector<float> band_;  // what share of a model's amplitude the sample rate carries
    double target_speed_ = 0, target_force_ = 0;
    double speed_ = 0, force_ = 0, smoothing_ = 1;
    std::uint64_t frame_ = 0;  // of the next sample handed out
    int quantum_ = 64;
    std::array<float, kNoiseBlock> ready_{};  // the quantum that is being handed out
};

}  // namespace tribo::noise
