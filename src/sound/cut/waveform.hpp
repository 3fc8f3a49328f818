// SPDX-License-Identifier: MIT
// A picture's worth of a long sound: extremes per column, and short stretches sample by sample.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tribo::sound {

struct Extremes {
    float min = 0, max = 0;
};

// A stretch to be kept whole; frames that the sound does not have stay out of `samples`.
struct Zoom {
    std::int64_t first_frame = 0;
    int frames = 0;
    std::vector<float> samples{};
};

// Listens to the left channel of a track as it is rendered. Columns double in width whenever there would be
// more than twice as many as asked for, so the length need not be known before. A few kilobytes.
class Waveform {
  public:
    explicit Waveform(int columns = 1000, std::vector<Zoom> zooms = {});  // columns >= 1

    // Interleaved stereo, the block after the last one.
    void add(std::span<const float> interleaved);

    // Between `columns` and twice as many (fewer for a sound shorter than that), each of column_frames()
    // frames but the last.
    const std::vector<Extremes>& columns() const { return columns_; }
    std::int64_t column_frames() const { return column_frames_; }
    std::int64_t frames() const { return frames_; }
    const std::vector<Zoom>& zooms() const { return zooms_; }
    // Largest |sample|.
    float peak() const { return peak_; }
    double rms() const;

  private:
    void add_frame(float sample);

    std::size_t wanted_;
    std::vector<Extremes> columns_;
    std::int64_t column_frames_ = 1;
    std::int64_t frames_ = 0;
    std::int64_t in_column_ = 0;  // frames in the last column
    std::vector<Zoom> zooms_;
    float peak_ = 0;
    double energy_ = 0;
};

}  // namespace tribo::sound
