// SPDX-License-Identifier: MIT
// Reads the file of a sweep (TOML; docs/sweep.md).
#pragma once

#include <string>
#include <string_view>

#include "job/file_source.hpp"
#include "job/sweep/sweep.hpp"

namespace tribo::job {

// Most values of one axis, and most axes of a plan with Sobol's points.
inline constexpr std::size_t kMostAxisValues = 100'000, kMostSampledAxes = 20;
// Most cases of a sweep.
inline constexpr std::uint64_t kMostSweepCases = 100'000'000;

// Axes stand in the order of the file. `file` is its name: errors carry it, and paths count from its folder.
// Refuses unknown keys, axes without values, distributions that are none, and plans of too many cases.
Result<Sweep> parse_sweep(std::string_view text, const std::string& file);

FileResult<Sweep> read_sweep(const FileSource& files, const std::string& path);

}  // namespace tribo::job
