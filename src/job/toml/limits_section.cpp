// SPDX-License-Identifier: MIT
// [limits]: what tool, spindle and part stand.
#include "base/text/limit_text.hpp"
#include "job/toml/sections.hpp"

namespace tribo::job {
namespace {

using namespace std::string_view_literals;

constexpr std::array kLimitKeys{"force_n"sv,          "torque_nm"sv,     "power_w"sv,     "spindle"sv,
                                "stress_n_per_mm2"sv, "deflection_mm"sv, "chip_min_mm"sv, "chip_max_mm"sv,
                                "multiplier"sv,       "tolerance_mm"sv};

std::vector<SpindlePoint> read_spindle(TomlSection& section) {
    std::vector<SpindlePoint> curve;
    const auto rows =
        section.triples("spindle", {kLimits.spindle_speed, kLimits.most_power, kLimits.most_torque},
                        "a curve [[rpm, W, N m], ...]");
    for (const auto& [rpm, power_w, torque_nm] : rows.value_or(std::vector<std::array<double, 3>>())) {
        if (!curve.empty() && !(rpm > curve.back().rpm)) {
            section.fail("spindle",
                         "the speeds of 'spindle' do not rise: " + plain_number(rpm) + " rpm stands after " +
                             plain_number(curve.back().rpm),
                         "write each speed once, from the lowest to the highest");
            return {};
        }
        curve.push_back({rpm, power_w, torque_nm});
    }
    for (const char* key : {"torque_nm", "power_w"}) {
        if (!curve.empty() && section.has(key))
            section.fail(key, "'" + std::string(key) + "' stands beside 'spindle', which says it already",
                         "keep one of them");
    }
    return curve;
}

}  // namespace

JobLimits read_limits(TomlFile& file, const toml::table& table) {
    TomlSection section(file, table, "[limits]", kLimitKeys);
    JobLimits limits;
    limits.force_n = section.number("force_n", kLimits.most_force);
    limits.torque_nm = section.number("torque_nm", kLimits.most_torque);
    limits.power_w = section.number("power_w", kLimits.most_power);
    limits.spindle = read_spindle(section);
    limits.stress_n_per_mm2 = section.number("stress_n_per_mm2", kLimits.most_stress);
    limits.deflection_mm = section.number("deflection_mm", kLimits.most_deflection);
    limits.chip_min_mm = section.number("chip_min_mm", kLimits.chip_limit);
    limits.chip_max_mm = section.number("chip_max_mm", kLimits.chip_limit);
    if (limits.chip_min_mm && limits.chip_max_mm && *limits.chip_min_mm >= *limits.chip_max_mm)
        section.fail("chip_min_mm", "'chip_min_mm' is not below 'chip_max_mm'", "exchange them");
    limits.multiplier = section.number("multiplier", kLimits.most_multiplier);
    limits.tolerance_mm = section.number("tolerance_mm", kLimits.tolerance);
    return limits;
}

}  // namespace tribo::job
