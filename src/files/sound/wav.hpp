// SPDX-License-Identifier: MIT
// Writes sound to a WAV file, block by block (libsndfile writes the container).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "files/files.hpp"

namespace tribo::files {

struct WavFormat {
    int sample_rate_hz = 48000;  // 8000 ... 192000
    int channels = 2;            // 1 ... 8
    // 16: integers with triangular dither of two steps' width from a counter hash (the same file every time);
    // exact zeros stay zeros, so silence is silent. 24: integers, rounded. 32: unchanged IEEE floats.
    int bits = 24;
    std::uint64_t dither_seed = 1;
};

// Longest sound of a WAV file, in frames: its lengths are 32-bit numbers of bytes (4.1 hours of 24 bits,
// stereo, 48 kHz). Check it before a long rendering.
std::int64_t longest_wav_frames(const WavFormat& format);

// After a failure later blocks are dropped, and finish() returns the first error. The file is written beside
// the file of that name, and replaces it at the end. An unfinished file leaves nothing. The bytes of a file
// depend only on format and samples.
class WavWriter {
  public:
    // Refuses a format out of range. `longest_frames`: limit of the frames, in addition to that of the
    // container.
    static FileResult<WavWriter> create(const std::string& path, const WavFormat& format = {},
                                        std::int64_t longest_frames = INT64_MAX);
    WavWriter(WavWriter&&) noexcept;
    WavWriter& operator=(WavWriter&&) = delete;
    ~WavWriter();

    // Writes interleaved samples, a multiple of `channels`, full scale -1 ... 1 (integers are clipped).
    void write(std::span<const float> interleaved);
    std::int64_t frames() const;
    FileResult<void> finish();

  private:
    struct State;
    explicit WavWriter(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tribo::files
