// SPDX-License-Identifier: MIT
// Sound to a loudspeaker: a plain callback that is asked for the next frames (RtAudio). Whoever renders knows
// nothing of devices; this file knows nothing of what is rendered.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "base/result.hpp"

namespace tribo::devices {

struct AudioOutOptions {
    int sample_rate_hz = 48000;
    int buffer_frames = 256;  // 128 ... 256 keep touch and sound together; the device may choose another
};

// Fills interleaved stereo, all of it. Runs on the device's thread: no allocation, lock, throw or log.
using AudioRender = std::function<void(std::span<float> interleaved)>;

// A stream to the default device, from open() until it is destroyed.
class AudioOut {
  public:
    // An error where there is no sound card or it refuses: the caller says so and goes on without.
    static Result<std::unique_ptr<AudioOut>> open(const AudioOutOptions& options, AudioRender render);
    ~AudioOut();
    AudioOut(const AudioOut&) = delete;
    AudioOut& operator=(const AudioOut&) = delete;

    const std::string& device() const { return device_; }
    int buffer_frames() const { return buffer_frames_; }
    // From render() to the loudspeaker, as far as the device tells: its own latency, or the two buffers that
    // every device has.
    double latency_s() const;

  private:
    struct Stream;
    AudioOut();
    std::unique_ptr<Stream> stream_;
    std::string device_;
    int sample_rate_hz_ = 0, buffer_frames_ = 0;
};

}  // namespace tribo::devices
