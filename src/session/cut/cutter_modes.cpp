// SPDX-License-Identifier: MIT
#include "session/cut/cutter_modes.hpp"

#include <cmath>
#include <string>

#include "base/text/limit_text.hpp"
#include "dynamics/tool_estimate.hpp"
#include "milling/tool/cutter_shape.hpp"

namespace tribo::session {
namespace {

std::string name_of(const milling::Cutter& cutter) {
    return cutter.number > 0 ? "tool T" + std::to_string(cutter.number) : "the tool";
}

// With three digits, or as a whole number.
std::string about(double value) {
    double digit = 1;
    while (value >= 1000 * digit) digit *= 10;
    return plain_number(digit * std::floor(value / digit + 0.5));
}

// "0.5 to 2" of 1 and a spread of 1.
std::string band(double value, double spread) {
    return plain_number(value / (1 + spread)) + " to " + plain_number(value * (1 + spread));
}

// What is estimated of one cutter, and how far it may be off.
std::string estimate_text(const milling::Cutter& cutter, std::span<const dynamics::Mode> modes) {
    std::string text = "the modes of " + name_of(cutter) + " are estimated, not measured: ";
    for (std::size_t n = 0; n < modes.size(); n += 2)  // of x and y alike
        text += (n > 0 ? " and " : "") + about(modes[n].frequency_hz) + " Hz with " +
                about(modes[n].stiffness_n_per_mm) + " N/mm";
    const dynamics::ModeSpread& spread = dynamics::kEstimateSpread;
    text += " at the tip; in truth " + band(1, spread.frequency) + " times that frequency, " +
            band(1, spread.stiffness) + " times that stiffness, damping " +
            band(modes.front().damping_ratio, spread.damping);
    const bool carbide = cutter.body == milling::CutterBody::carbide;
    text += std::string("; body of ") + (carbide ? "carbide" : "high-speed steel");
    if (cutter.holder.empty()) text += ", and no [holder]: a rigid one";
    return text;
}

}  // namespace

Result<void> add_modes(const job::Job& job, MillSetup& setup, Warnings& warnings) {
    if (!job.can_vibrate()) return {};
    for (const milling::Cutter& cutter : setup.cutters) {
        if (!cutter.has_profile()) continue;
        const std::string_view kind = milling::kCutterKindWords[static_cast<std::size_t>(cutter.kind)];
        return fail_at(
            job.file, 0, 0,
            name_of(cutter) + " is a " + std::string(kind) +
                ": vibration is computed for flat, ball and bull cutters only",
            "remove what bends ([[mode]], [[frf]], estimate), or replace the cutter by the bull or flat "
            "one that is nearest to it");
    }
    setup.modes_of_cutter.assign(setup.cutters.size(), job.modes);
    if (!job.estimate) return {};
    for (std::size_t n = 0; n < setup.cutters.size(); ++n) {
        const milling::Cutter& cutter = setup.cutters[n];
        if (!(cutter.stickout_mm > 0)) {
            return fail_at(
                job.file, job.estimate->line, job.estimate->column,
                "the modes of " + name_of(cutter) + " cannot be estimated: its stick-out is not known",
                "describe it as a [[cutter]] with stickout_mm, from the tip to the holder's face");
        }
        const std::vector<dynamics::Mode> modes = dynamics::estimated_modes(cutter);
        warnings.push_back({job.file, job.estimate->line, estimate_text(cutter, modes)});
        setup.modes_of_cutter[n].insert(setup.modes_of_cutter[n].end(), modes.begin(), modes.end());
    }
    return {};
}

}  // namespace tribo::session
