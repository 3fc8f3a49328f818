// SPDX-License-Identifier: MIT
// Runs `tribo feel` after its flags are read: part, hand, servo and trace.
#pragma once

#include <optional>
#include <string>

#include "app/feel/arm_call.hpp"
#include "app/render/program_flags.hpp"

namespace tribo::app {

struct FeelCall {
    std::string job, stroke, out;  // job: also a program or a model
    ProgramFlags program;
    std::string mode = "inspect", device = "simulated", stats;
    double rate_hz = 1000;
    std::optional<double> probe_mm;  // radius; 0: a point
    ArmCall arm;
    std::optional<double> stiffness_n_per_mm, friction_static, friction_kinetic, resolution_mm, until_s;
    std::optional<double> unit_mm;  // of a model
    double scale = 1;               // of a model
    std::string source;             // a library with the user's force; empty: none
    bool real_time = false, texture = true, compressive = false;
    std::string profile, bake;
    int threads = 0;
};

// Returns the exit code. Prints errors to stderr and a summary to stdout.
int feel(const FeelCall& call);

}  // namespace tribo::app
