// SPDX-License-Identifier: MIT
// Overview of a long sound for a plot: minimum and maximum per column, and short windows sample by sample.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tribo::sound {

struct MinMax {
    float min = 0, max = 0;
};

// A window that is kept sample by sample. `samples` contains only frames inside of the sound.
struct DetailWindow {
    std::int64_t first_frame = 0;
    int frames = 0;
    std::vector<float> samples{};
};

// Collects the left channel of a track while it is rendered. The length need not be known: the column width
// doubles when there are more than twice the requested columns. A few kilobytes.
class Waveform {
  public:
    explicit Waveform(int columns = 1000, std::vector<DetailWindow> zooms = {});  // columns >= 1

    // The next block, interleaved stereo.
    void add(std::span<const float> interleaved);

    // Between `columns` and twice as many columns (fewer for a very short sound). All but the last have
    // column_frames() frames.
    const std::vector<MinMax>& columns() const { return columns_; }
    std::int64_t column_frames() const { return column_frames_; }
    std::int64_t frames() const { return frames_; }
    const std::vector<DetailWindow>& zooms() const { return zooms_; }
    // Largest |sample|.
    float peak() const { return peak_; }

  private:
    void add_frame(float sample);

    std::size_t wanted_;
    std::vector<MinMax> columns_;
    std::int64_t column_frames_ = 1;
    std::int64_t frames_ = 0;
    std::int64_t in_column_ = 0;  // frames in the last column
    std::vector<DetailWindow> zooms_;
    float peak_ = 0;
};

}  // namespace tribo::sound
