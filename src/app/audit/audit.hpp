// SPDX-License-Identifier: MIT
// Runs `tribo audit` after its flags are read: mills the job and holds each line against the limits.
#pragma once

#include <optional>
#include <string>

#include "app/render/program_flags.hpp"

namespace tribo::app {

struct AuditCall {
    std::string job, out;  // a job or a program; a folder, may be empty
    ProgramFlags program;
    std::optional<double> resolution_mm;
    std::optional<double> fail_over;  // a ratio to a limit
    std::optional<int> uncertain;     // cases of what is known with a spread only
    bool json = false;
    bool stable = false;  // propose spindle speeds without chatter
};

// Returns the exit code.
int audit(const AuditCall& call);

}  // namespace tribo::app
