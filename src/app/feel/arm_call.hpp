// SPDX-License-Identifier: MIT
// Flags for position, scale and delay of a haptic arm, for all verbs that use one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/vec3.hpp"
#include "devices/arm/mounting.hpp"
#include "haptics/device/device_limits.hpp"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace tribo::app {

struct ArmCall {
    std::vector<double> at_mm;  // zero of the arm, stock frame; empty: middle of the top of the stock
    double scale = 1;           // millimetres of the part per millimetre of the hand
    double delay_ms = 0;        // round trip of arm, driver and connection

    double delay_s() const { return 1e-3 * delay_ms; }
};

// Accepts the names of arms and of these hands that are simulated.
CLI::Validator device_name(std::vector<std::string> hands);
// `call` must live as long as the verb.
void add_arm_flags(CLI::App& verb, ArmCall& call);
// Stiffness of a surface: the requested one or 0.5 N/mm, limited by the stability of the arm and the delay.
// If it is less than requested, `warnings` gets a warning about `file`.
double stable_stiffness(std::optional<double> asked_n_per_mm, const haptics::DeviceLimits& limits,
                        double rate_hz, const ArmCall& call, const std::string& file, Warnings& warnings);
devices::Mounting mounting(const ArmCall& call, const Box3& stock);

}  // namespace tribo::app
