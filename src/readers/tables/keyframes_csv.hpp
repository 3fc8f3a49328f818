// SPDX-License-Identifier: MIT
// Keyframe tables: the poses that a five-axis motion passes through, one per line of comma-separated text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "motion/curve/keyframe.hpp"

namespace tribo::readers {

struct KeyframeOptions {
    std::string source_name;                // stands in messages
    double unit_mm = 1;                     // length of one unit of x, y and z, mm; finite, > 0
    std::size_t max_keyframes = 4'000'000;  // more are refused: at 100 bytes each they take 400 MB
};

// Reads the header `x,y,z,i,j,k[,weight][,feed_mm_per_min]` and a keyframe per line: tip in mm, axis from the
// tip to the shank (made unit), weight > 0, feed >= 0; an empty weight or feed says nothing. Blank lines and
// those that start with '#' are left out. At least two keyframes, no two in a row the same. Linear in the
// bytes.
Result<std::vector<motion::Keyframe>> read_keyframes(std::string_view bytes,
                                                     const KeyframeOptions& options = {});

// The table that read_keyframes() reads back to the same keyframes; weight and feed only where one says
// something. Axes must be unit to come back the same.
std::string write_keyframes(const std::vector<motion::Keyframe>& keyframes);

}  // namespace tribo::readers
