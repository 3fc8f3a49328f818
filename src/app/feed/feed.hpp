// SPDX-License-Identifier: MIT
// Runs `tribo feed` after its flags are read: mills the job, finds the feed of each block, writes the program
// with other feed words, reads it again and mills it again.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/render/program_flags.hpp"

namespace tribo::app {

struct FeedCall {
    std::string job, out;  // a job or a program; a program
    ProgramFlags program;
    std::optional<double> resolution_mm;
    // Targets; none of them: the limits of the audit.
    std::optional<double> force_n, power_w, stress_n_per_mm2, deflection_mm;
    std::optional<std::pair<double, double>> chip_mm;  // least and largest
    bool sure = false, in_place = false, json = false;
    bool stable = false;             // first choose spindle speeds without chatter
    bool unroll = false;             // first write the program anew, a block for each move
    std::optional<double> split_mm;  // longest straight block then

    bool has_target() const { return force_n || power_w || stress_n_per_mm2 || deflection_mm; }
};

// Returns the exit code.
int feed(const FeedCall& call);

}  // namespace tribo::app
