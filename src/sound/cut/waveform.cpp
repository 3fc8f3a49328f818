// SPDX-License-Identifier: MIT
#include "sound/cut/waveform.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "sound/play/soundtrack.hpp"

namespace tribo::sound {

Waveform::Waveform(int columns, std::vector<DetailWindow> zooms)
    : wanted_(static_cast<std::size_t>(columns)), zooms_(std::move(zooms)) {
    assert(columns >= 1);
    columns_.reserve(2 * wanted_);
}

void Waveform::add(std::span<const float> interleaved) {
    for (std::size_t i = 0; i < interleaved.size(); i += kChannels) add_frame(interleaved[i]);
}

void Waveform::add_frame(float sample) {
    for (DetailWindow& zoom : zooms_) {
        if (frames_ >= zoom.first_frame && frames_ - zoom.first_frame < zoom.frames) {
            zoom.samples.push_back(sample);
        }
    }
    ++frames_;
    peak_ = std::max(peak_, std::abs(sample));
    if (!columns_.empty() && in_column_ < column_frames_) {
        columns_.back() = {std::min(columns_.back().min, sample), std::max(columns_.back().max, sample)};
        ++in_column_;
        return;
    }
    if (columns_.size() == 2 * wanted_) {
        for (std::size_t i = 0; i < wanted_; ++i) {
            const MinMax a = columns_[2 * i], b = columns_[2 * i + 1];
            columns_[i] = {std::min(a.min, b.min), std::max(a.max, b.max)};
        }
        columns_.resize(wanted_);
        column_frames_ *= 2;
    }
    columns_.push_back({sample, sample});
    in_column_ = 1;
}

}  // namespace tribo::sound
