// SPDX-License-Identifier: MIT
#include "app/arm_call.hpp"

#include "app/options.hpp"
#include "haptics/loop_delay.hpp"

namespace tribo::app {

void add_arm_flags(CLI::App& verb, ArmCall& call) {
    verb.add_option("--arm-at", call.at_mm,
                    "Where an arm's own zero lies in the stock; the middle of its top if absent")
        ->expected(3)
        ->check(finite_number(-1e6, 1e6))
        ->type_name("X Y Z");
    verb.add_option("--arm-scale", call.scale,
                    "Millimetres of the part per millimetre of the hand; 1 if absent")
        ->check(finite_number(0, 1e3))
        ->type_name("TIMES");
    verb.add_option("--delay", call.delay_ms,
                    "Of arm, driver and line, both ways together, 0 to 20; feel's simulated hand gets it")
        ->check(CLI::Range(0.0, 1e3 * haptics::kMostDelayS))
        ->type_name("MS");
}

devices::Mounting mounting(const ArmCall& call, const Box3& stock) {
    const Vec3 middle = stock.centre();
    const Vec3 at = call.at_mm.empty() ? Vec3{middle.x, middle.y, stock.max.z}
                                       : Vec3{call.at_mm[0], call.at_mm[1], call.at_mm[2]};
    return {at, call.scale};
}

}  // namespace tribo::app
