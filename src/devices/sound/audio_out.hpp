// SPDX-License-Identifier: MIT
// Sound output to the default device (RtAudio). A callback provides the next frames. The renderer does not
// depend on devices, and this file does not depend on the renderer.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "base/result.hpp"

namespace tribo::devices {

struct AudioOutOptions {
    int sample_rate_hz = 48000;
    int buffer_frames = 256;  // 128 ... 256 keep touch and sound in sync; the device may choose another size
};

// Fills all of the interleaved stereo buffer. Runs on the device thread: no allocation, lock, throw or log.
using AudioRender = std::function<void(std::span<float> interleaved)>;

// A stream to the default device, from open() until it is destroyed.
class AudioOut {
  public:
    // Returns an error without a sound card, or if it refuses. The caller reports it and continues without
    // sound.
    static Result<std::unique_ptr<AudioOut>> open(const AudioOutOptions& options, AudioRender render);
    ~AudioOut();
    AudioOut(const AudioOut&) = delete;
    AudioOut& operator=(const AudioOut&) = delete;

    const std::string& device() const { return device_; }
    int buffer_frames() const { return buffer_frames_; }
    // Latency from render() to the loudspeaker: the value of the device, but at least two buffers.
    double latency_s() const;

  private:
    struct Stream;
    AudioOut();
    std::unique_ptr<Stream> stream_;
    std::string device_;
    int sample_rate_hz_ = 0, buffer_frames_ = 0;
};

}  // namespace tribo::devices
