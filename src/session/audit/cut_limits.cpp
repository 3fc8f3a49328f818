// SPDX-License-Identifier: MIT
#include "session/audit/cut_limits.hpp"

#include <algorithm>

#include "base/text/decimal.hpp"
#include "milling/engagement/chip.hpp"

namespace tribo::session {
namespace {

// Bending strength of a fluted body over a factor of safety, N/mm2. The strength of ground test bars (ISO
// 3327) is twice as high; flutes, edges and fatigue take the rest.
struct Strength {
    double low, high;
    const char* what;
};
constexpr Strength kCarbide{
    1500, 2000, "carbide body: bending strength 1500 to 2000 N/mm2 over a factor of 2 to 3, a rule of thumb"};
constexpr Strength kHighSpeedSteel{
    1500, 2500,
    "body of high-speed steel: bending strength 1500 to 2500 N/mm2 over a factor of 2 to 3, assumed"};
constexpr double kLeastFactor = 2, kMostFactor = 3;

// How far a rule of thumb about chips may be off: factors on its value.
constexpr double kChipLow = 0.5, kChipHigh = 2;

CutLimit exact(double value, std::string source) {
    return {value, value, value, std::move(source), false};
}

CutLimit stress_of(milling::CutterBody body) {
    const Strength& s = body == milling::CutterBody::carbide ? kCarbide : kHighSpeedSteel;
    const double value = 0.5 * (s.low + s.high) / (0.5 * (kLeastFactor + kMostFactor));
    return {value, s.low / kMostFactor, s.high / kLeastFactor, s.what, true};
}

CutLimit rough(double value, std::string source) {
    return {value, kChipLow * value, kChipHigh * value, std::move(source), true};
}

constexpr const char* kStated = "[limits] of the job";

ToolLimits tool_limits(const job::JobLimits& stated, const milling::Cutter& cutter, bool can_vibrate) {
    ToolLimits limits;
    const auto set = [&](LoadKind kind, const std::optional<double>& value) {
        if (value) limits.most[index_of(kind)] = exact(*value, kStated);
    };
    limits.most[index_of(LoadKind::stress)] = stress_of(cutter.body);
    limits.most[index_of(LoadKind::chip)] =
        rough(milling::kOverloadShare * cutter.diameter_mm,
              format_decimal(100 * milling::kOverloadShare) + " % of the diameter, a rule of thumb");
    if (can_vibrate)
        limits.most[index_of(LoadKind::multiplier)] =
            exact(1, "theory of chatter: above 1 a vibration grows");
    set(LoadKind::force, stated.force_n);
    set(LoadKind::torque, stated.torque_nm);
    set(LoadKind::power, stated.power_w);
    set(LoadKind::stress, stated.stress_n_per_mm2);
    set(LoadKind::deflection, stated.deflection_mm);
    set(LoadKind::chip, stated.chip_max_mm);
    if (can_vibrate) set(LoadKind::multiplier, stated.multiplier);
    limits.least_chip =
        stated.chip_min_mm
            ? exact(*stated.chip_min_mm, kStated)
            : rough(milling::kRubbingChipMm, "about a third of the radius of a used edge, a rule of thumb");
    return limits;
}

}  // namespace

job::SpindlePoint spindle_at(std::span<const job::SpindlePoint> curve, double rpm) {
    const auto above = std::ranges::find_if(curve, [&](const auto& point) { return point.rpm >= rpm; });
    if (above == curve.end()) return curve.back();
    if (above == curve.begin()) return {rpm, above->power_w * rpm / above->rpm, above->torque_nm};
    const auto below = above - 1;
    const double share = (rpm - below->rpm) / (above->rpm - below->rpm);
    const auto between = [&](double a, double b) { return a + share * (b - a); };
    return {rpm, between(below->power_w, above->power_w), between(below->torque_nm, above->torque_nm)};
}

CutLimits cut_limits(const job::Job& job, const MillSetup& setup) {
    CutLimits limits;
    limits.spindle = job.limits.spindle;
    limits.tolerance_mm = job.limits.tolerance_mm;
    for (const milling::Cutter& cutter : setup.cutters) {
        ToolLimits& of_tool =
            limits.of_cutter.emplace_back(tool_limits(job.limits, cutter, job.can_vibrate()));
        if (!limits.spindle.empty()) {
            // Their values follow from the speed of a row.
            for (const LoadKind kind : {LoadKind::torque, LoadKind::power})
                of_tool.most[index_of(kind)] = exact(0, "'spindle' in [limits] of the job");
        }
        if (cutter.stickout_mm > 0) continue;
        const std::string name = cutter.number > 0 ? "tool T" + std::to_string(cutter.number) : "the cutter";
        limits.assumptions.push_back(
            {job.file, 0,
             name + " has no stickout_mm: its holder is taken to begin at the end of the edges, " +
                 format_decimal(cutter.length_mm) + " mm above the tip; a longer one bends more"});
    }
    const double rpm = setup.rpm_of_move.empty() ? 0 : *std::ranges::max_element(setup.rpm_of_move);
    if (!limits.spindle.empty() && rpm > limits.spindle.back().rpm)
        limits.assumptions.push_back({job.file, 0,
                                      "the curve 'spindle' ends at " +
                                          format_decimal(limits.spindle.back().rpm) +
                                          " rpm, and the program runs at " + format_decimal(rpm) +
                                          ": beyond its end the last values are taken"});
    return limits;
}

}  // namespace tribo::session
