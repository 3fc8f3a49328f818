// SPDX-License-Identifier: MIT
// Long programs of three kinds, as CAM systems write them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace tribo::bench {

enum class LongProgram {
    contour,  // D3 flat, the same contour of 195 moves of 1 mm, 0.05 mm deeper each time, 60 times; then
              // aside
    pocket,   // the same as a pocket of 13 rows
    raster,   // D6 ball over a wavy floor, lines of 100 mm in moves of 0.5 mm, 0.4 mm aside
    tilted,   // D12 ball, five axes, lines of 300 mm in moves of 3 mm, layers of 350 lines 1 mm apart
};

// Writes a job of at least this many moves, and its program, into the folder. Returns the path of the job.
std::string write_long_program(LongProgram kind, std::size_t moves, const std::filesystem::path& folder);

}  // namespace tribo::bench
