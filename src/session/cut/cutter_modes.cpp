// SPDX-License-Identifier: MIT
#include "session/cut/cutter_modes.hpp"

#include <cstdio>
#include <string>

#include "dynamics/tool_estimate.hpp"

namespace tribo::session {
namespace {

std::string name_of(const milling::Cutter& cutter) {
    return cutter.number > 0 ? "tool T" + std::to_string(cutter.number) : "the tool";
}

// What is estimated of one cutter, and how far it may be off.
std::string estimate_text(const milling::Cutter& cutter, std::span<const dynamics::Mode> modes) {
    std::string text = "the modes of " + name_of(cutter) + " are estimated, not measured: ";
    char part[160];
    for (std::size_t n = 0; n < modes.size(); n += 2) {  // of x and y alike
        std::snprintf(part, sizeof part, "%s%.0f Hz with %.3g N/mm", n > 0 ? " and " : "",
                      modes[n].frequency_hz, modes[n].stiffness_n_per_mm);
        text += part;
    }
    const dynamics::ModeSpread& spread = dynamics::kEstimateSpread;
    const double damping = modes.front().damping_ratio;
    std::snprintf(
        part, sizeof part,
        " at the tip; in truth %.3g to %.3g times that frequency, %.3g to %.3g times that stiffness, "
        "damping %.3g to %.3g",
        1 / (1 + spread.frequency), 1 + spread.frequency, 1 / (1 + spread.stiffness), 1 + spread.stiffness,
        damping / (1 + spread.damping), damping * (1 + spread.damping));
    text += part;
    const bool carbide = cutter.body == milling::CutterBody::carbide;
    text += std::string("; body of ") + (carbide ? "carbide" : "high-speed steel");
    if (cutter.holder.empty()) text += ", and no [holder]: a rigid one";
    return text;
}

}  // namespace

Result<void> add_modes(const job::Job& job, MillSetup& setup, Warnings& warnings) {
    if (!job.can_vibrate()) return {};
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
