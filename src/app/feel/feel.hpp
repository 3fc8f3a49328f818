// SPDX-License-Identifier: MIT
// What `tribo feel` does once its flags are read: a part, a hand, a servo, a trace.
#pragma once

#include <optional>
#include <string>

#include "app/feel/arm_call.hpp"

namespace tribo::app {

struct FeelCall {
    std::string job, stroke, out;
    std::string mode = "inspect", device = "simulated", stats;
    double rate_hz = 1000;
    double probe_mm = 0;
    ArmCall arm;
    std::optional<double> stiffness_n_per_mm, friction_static, friction_kinetic, resolution_mm, until_s;
    std::optional<double> unit_mm;  // of a model
    double scale = 1;               // of a model
    std::string source;             // a library with a force of one's own; empty: none
    bool real_time = false, texture = true, compressive = false;
    std::string profile, bake;
    int threads = 0;
};

// The exit code. Says on stderr what is wrong; prints what was felt on stdout.
int feel(const FeelCall& call);

}  // namespace tribo::app
