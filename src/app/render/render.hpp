// SPDX-License-Identifier: MIT
// Runs `tribo render` after its flags are read: input files, session, output files.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "app/render/program_flags.hpp"

namespace tribo::app {

struct RenderCall {
    std::string job, out;  // a job or a program; a folder
    ProgramFlags program;
    std::optional<double> resolution_mm, until_s;
    int sample_rate_hz = 48000;
    std::set<std::string> only;  // of summary, forces, sound, mesh, report; empty: all
    std::optional<double> memory_mb;
    std::optional<int> uncertain;  // cases of what is known with a spread only
    bool as_published = false;
    int threads = 0;  // 0: all

    bool wants(const std::string& output) const { return only.empty() || only.contains(output); }
};

// Returns the exit code. Prints errors to stderr; summary and output folder to stdout.
int render(const RenderCall& call);

}  // namespace tribo::app
