// SPDX-License-Identifier: MIT
// Runs `tribo compare` after its flags are read: two runs, milled or read from render folders, side by side.
#pragma once

#include <optional>
#include <string>

#include "app/render/program_flags.hpp"
#include "session/compare/compared_rows.hpp"

namespace tribo::app {

struct CompareCall {
    std::string a, b, out;  // jobs, programs or render folders; a folder
    ProgramFlags program;   // for those of the two that are programs
    std::optional<double> resolution_mm;
    std::optional<session::JoinBy> by;
    bool json = false;
};

// Returns the exit code.
int compare(const CompareCall& call);

}  // namespace tribo::app
