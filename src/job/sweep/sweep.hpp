// SPDX-License-Identifier: MIT
// A sweep as its file describes it (docs/sweep.md). Plain data; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sweep/plan.hpp"

namespace tribo::job {

enum class SweepResult : std::uint8_t { summary, audit, stability };

struct Sweep {
    std::string file;
    std::string base;      // the job that all cases change; may be empty where `programs` is given
    std::string programs;  // a folder; each file in it is a value of the axis `program`
    std::vector<SweepResult> compute;
    std::optional<double> resolution_mm, until_s;
    sweep::Plan plan;  // without the axis `program`
};

// The key of the axis that a folder of programs makes.
inline constexpr const char* kProgramAxis = "program";

}  // namespace tribo::job
