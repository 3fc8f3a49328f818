// SPDX-License-Identifier: MIT
// The sound of rubbing a material: noise of the learned models nearest to the speed and force of the finger,
// mixed with equal power, at the level of the recordings.
//
//     FrictionVoice voice(material.voices, {.sample_rate_hz = 48000});
//     voice.set_target(120, 0.8);        // mm/s, N: at any time
//     voice.render(block);               // in the audio callback
//
// Speed and force take effect at the next quantum (1.33 ms) and are smoothed over a millisecond, so steps do
// not click. The output depends on the seed, the targets and the frames at which they are set, never on block
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
    line_spectrum  // one model with interpolated line spectral frequencies: peaks move
};

struct FrictionOptions {
    double sample_rate_hz = 48000;  // 1000 ... 192000; at the rate of a servo it gives vibration
    std::uint64_t seed = 1;
    Interpolation interpolation = Interpolation::mix;
    // Without textures: coloured Gaussian noise, for comparison.
    bool gaussian = false;
    // Frames between two updates of the targets: 1, 2, 4 ... 64; 0: the value nearest to 1.33 ms.
    int quantum_frames = 0;
    // The generation step of the paper as printed: all models always run, amplitudes are mixed linearly (3 dB
    // too low half way), the mean power is used as gain, nothing is smoothed, a finger at rest is audible.
    bool as_published = false;
};

// Construction allocates; everything else is real-time safe. One thread at a time.
class FrictionVoice {
  public:
    // `voices`: at least one model; copied.
    explicit FrictionVoice(const MaterialVoices& voices, const FrictionOptions& options = {});

    // Sets the finger speed along the surface (its magnitude) and the force into the surface. Values <= 0 and
    // NaN give silence.
    void set_target(double speed_mm_per_s, double force_n);

    // Renders the next frames, mono, full scale 1 (clipped). Overwrites `out`.
    void render(std::span<float> out);

    // Goes to a frame of the stream and to silence. The same targets then give the same samples.
    void seek(std::uint64_t frame);
    std::uint64_t frame() const { return frame_; }

    // RMS level of the current target, full scale 1.
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
    // For Interpolation::line_spectrum: the one audible model, last in noises_, and its angles.
    std::vector<std::vector<double>> lines_;
    std::vector<double> line_, predictor_, reflection_, line_work_;
    std::vector<float> band_;  // share of the amplitude of a model that the sample rate can carry
    double target_speed_ = 0, target_force_ = 0;
    double speed_ = 0, force_ = 0, smoothing_ = 1;
    std::uint64_t frame_ = 0;  // of the next sample to return
    int quantum_ = 64;
    std::array<float, kNoiseBlock> ready_{};  // the quantum that is being returned
};

}  // namespace tribo::noise
