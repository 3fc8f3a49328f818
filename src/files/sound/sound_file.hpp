// SPDX-License-Identifier: MIT
// Reads recordings: WAV and FLAC at any rate and depth (decoded by libsndfile).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "files/files.hpp"

namespace tribo::files {

struct SoundFile {
    double sample_rate_hz = 0;
    int channels = 0;
    int bits = 0;                 // 0: floating point or compressed
    std::vector<double> samples;  // of the channel with the most energy; full scale 1
    Warnings warnings;
};

// 22 minutes at 48 kHz, mono. Longer files are refused before memory is allocated for them.
inline constexpr std::int64_t kMostSoundSamples = std::int64_t{1} << 26;
inline constexpr double kLeastSoundHz = 4000, kMostSoundHz = 384000;

// Refuses other containers, rates out of range, samples that are not finite, and empty files. A file that is
// shorter than its header states is read to its end, with a warning. Never throws.
Result<SoundFile> parse_sound(std::string_view bytes, const std::string& source_name);
FileResult<SoundFile> read_sound(const std::string& path);

}  // namespace tribo::files
