// SPDX-License-Identifier: MIT
#include "app/feel/arm_call.hpp"

#include <algorithm>
#include <cstdio>

#include "app/options.hpp"
#include "devices/arm/device_search.hpp"
#include "haptics/servo/loop_delay.hpp"

namespace tribo::app {

CLI::Validator device_name(std::vector<std::string> hands) {
    const auto check = [hands](std::string& name) -> std::string {
        if (devices::is_arm(name) || std::ranges::find(hands, name) != hands.end()) return "";
        std::string known;
        for (const std::string& hand : hands) known += hand + ", ";
        return "there is no device '" + name + "'; try " + known +
               "auto, openhaptics, forcedimension, haply, falcon:FIRMWARE or serial:PORT";
    };
    return CLI::Validator(check, "");
}

void add_arm_flags(CLI::App& verb, ArmCall& call) {
    verb.add_option("--arm-at", call.at_mm,
                    "Where an arm's own zero lies in the stock; the middle of its top if absent")
        ->expected(3)
        ->check(within(kLimits.coordinate))
        ->type_name("X Y Z");
    verb.add_option("--arm-scale", call.scale,
                    "Millimetres of the part per millimetre of the hand; 1 if absent")
        ->check(within(kLimits.arm_scale))
        ->type_name("TIMES");
    verb.add_option("--delay", call.delay_ms,
                    "Of arm, driver and line, both ways together, 0 to 20; feel's simulated hand gets it")
        ->check(within(kLimits.arm_delay))
        ->type_name("MS");
}

double stable_stiffness(std::optional<double> asked, const haptics::DeviceLimits& limits, double rate_hz,
                        const ArmCall& call, const std::string& file, Warnings& warnings) {
    const double wanted = asked.value_or(0.5);
    const double passive = haptics::passive_stiffness_n_per_mm(1 / rate_hz, call.delay_s()) / limits.scale;
    const double most = std::min(limits.max_stiffness_n_per_mm, passive);
    if (wanted <= most) return wanted;
    char text[250], at_scale[60] = "";
    if (limits.scale != 1) std::snprintf(at_scale, sizeof at_scale, " at a scale of %g", limits.scale);
    if (passive < limits.max_stiffness_n_per_mm) {
        std::snprintf(
            text, sizeof text,
            "a stiffness of %g N/mm would push the hand by itself at a delay of %g ms and %g Hz%s: %.3g "
            "stands in",
            wanted, call.delay_ms, rate_hz, at_scale, most);
    } else {
        std::snprintf(text, sizeof text,
                      "a stiffness of %g N/mm is more than '%.*s' keeps stable%s: %g stands in", wanted,
                      static_cast<int>(limits.name.size()), limits.name.data(), at_scale, most);
    }
    // Warn only about a requested value.
    if (asked) warnings.push_back({file, 0, text});
    return most;
}

devices::Mounting mounting(const ArmCall& call, const Box3& stock) {
    const Vec3 middle = stock.centre();
    const Vec3 at = call.at_mm.empty() ? Vec3{middle.x, middle.y, stock.max.z}
                                       : Vec3{call.at_mm[0], call.at_mm[1], call.at_mm[2]};
    return {at, call.scale};
}

}  // namespace tribo::app
