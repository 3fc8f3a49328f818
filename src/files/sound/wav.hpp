// SPDX-License-Identifier: MIT
// Sound into a WAV file, block by block (libsndfile writes the container).
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
    // 16: integers with triangular dither of two steps' width from a counter hash (the same file every
    //     time); exact zeros stay zeros, so silence is silent. 24: integers, rounded. 32: IEEE floats as they
    //     come.
    int bits = 24;
    std::uint64_t dither_seed = 1;
};

// Longest sound that a WAV file holds, in frames: its lengths are 32-bit numbers of bytes (4.1 hours of 24
// bits, stereo, 48 kHz). Ask before a long rendering.
std::int64_t longest_wav_frames(const WavFormat& format);

// A failure sticks: later blocks are dropped and finish() tells the first one. It grows beside a file of
// that name, which it replaces in the end; one that was not finished leaves nothing. The bytes of a file
// depend on format and samples alone.
class WavWriter {
  public:
    // Refuses a format out of range. `longest_frames`: refuse more than this many (and than the container
    // holds).
    static FileResult<WavWriter> create(const std::string& path, const WavFormat& format = {},
                                        std::int64_t longest_frames = INT64_MAX);
    WavWriter(WavWriter&&) noexcept;
    WavWriter& operator=(WavWriter&&) = delete;
    ~WavWriter();

    // Interleaved samples, full scale -1 ... 1 (beyond it integers stop at their ends), a multiple of
    // `channels` of them.
    void write(std::span<const float> interleaved);
    std::int64_t frames() const;
    FileResult<void> finish();

  private:
    struct State;
    explicit WavWriter(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tribo::files
