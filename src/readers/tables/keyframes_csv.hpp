// SPDX-License-Identifier: MIT
// Keyframe tables: the poses of a five-axis motion, one per line of comma-separated text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "motion/curve/keyframe.hpp"

namespace tribo::readers {

struct KeyframeOptions {
    std::string source_name;                // used in messages
    double unit_mm = 1;                     // length of one unit of x, y and z, mm; finite, > 0
    std::size_t max_keyframes = 4'000'000;  // more are refused: at 100 bytes each they take 400 MB
};

// Reads the header `x,y,z,i,j,k[,weight][,feed_mm_per_min]` and a keyframe per line: tip in mm, axis from the
// tip to the shank (it is normalised), weight > 0, feed >= 0. An empty weight or feed is not stated. Blank
// lines and lines that start with '#' are skipped. At least two keyframes; two consecutive ones must differ.
// Linear in the bytes.
Result<std::vector<motion::Keyframe>> read_keyframes(std::string_view bytes,
                                                     const KeyframeOptions& options = {});

// Writes a table that read_keyframes() reads back to the same keyframes. Weight and feed are written only if
// a keyframe states them. Axes must be unit vectors to come back unchanged.
std::string write_keyframes(const std::vector<motion::Keyframe>& keyframes);

}  // namespace tribo::readers
