// SPDX-License-Identifier: MIT
// The flags that say where a haptic arm stands and how late it is, for every verb that drives one.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/vec3.hpp"
#include "devices/arm/mounting.hpp"
#include "haptics/device/device_limits.hpp"

namespace tribo::app {

struct ArmCall {
    std::vector<double> at_mm;  // its zero, stock frame; empty: the middle of the stock's top
    double scale = 1;           // millimetres of the part per millimetre of the hand
    double delay_ms = 0;        // of arm, driver and line, both ways together

    double delay_s() const { return 1e-3 * delay_ms; }
};

// `call` lives as long as the verb.
void add_arm_flags(CLI::App& verb, ArmCall& call);
// Of a surface: what was asked for, else 0.5 N/mm, at most what the arm keeps stable and the delay allows.
// Says so in `warnings`, about `file`, where that is less than was asked for.
double stable_stiffness(std::optional<double> asked_n_per_mm, const haptics::DeviceLimits& limits,
                        double rate_hz, const ArmCall& call, const std::string& file, Warnings& warnings);
devices::Mounting mounting(const ArmCall& call, const Box3& stock);

}  // namespace tribo::app
