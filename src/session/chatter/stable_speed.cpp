// SPDX-License-Identifier: MIT
#include "session/chatter/stable_speed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "session/chatter/advice.hpp"
#include "session/chatter/probability.hpp"

namespace tribo::session {
namespace {

// A spindle runs this much off its speed.
constexpr double kOff = 0.01;
// Speeds whose multipliers differ by less count as one: the one nearest to the old speed is taken.
constexpr double kAlike = 0.02;

double multiplier_at(const std::vector<SteadyCut>& cuts, double rpm) {
    double most = 0;
    for (const SteadyCut& cut : cuts)
        for (const double off : {1 - kOff, 1.0, 1 + kOff})
            most = std::max(most, cut.at(off * rpm, cut.axial_depth_mm).multiplier);
    return most;
}

}  // namespace

bool StableSpeed::is_stable() const {
    return new_multiplier <= 1 && new_probability.value_or(0) <= dynamics::kRarely;
}

void StableSpeedSearch::add(const milling::CutRow& row, double multiplier) {
    Tool& tool = tools_[row.cutter];
    tool.worst.add(row, row.duration_s(), multiplier);
    if (!tool.heaviest || row.chip_mm3_per_s() > tool.heaviest->chip_mm3_per_s()) tool.heaviest = row;
}

std::vector<StableSpeed> StableSpeedSearch::find(const std::vector<double>& most_rpm,
                                                 const ParallelFor& parallel) const {
    std::vector<StableSpeed> found;
    for (std::size_t n = 0; n < tools_.size(); ++n) {
        const milling::CutRow* worst = tools_[n].worst.row();
        if (worst == nullptr) continue;
        std::vector<SteadyCut> cuts{steady_cut_of(*worst, setup_, kRowBands)};
        SteadyCut heaviest = steady_cut_of(*tools_[n].heaviest, setup_, kRowBands);
        heaviest.spindle_rpm = cuts[0].spindle_rpm;
        cuts.push_back(std::move(heaviest));
        const double old = cuts[0].spindle_rpm;
        StableSpeed& speed = found.emplace_back();
        speed.cutter = n;
        speed.line = worst->line;
        speed.old_rpm = speed.new_rpm = old;
        speed.most_rpm = std::max(most_rpm[n], old);
        speed.old_multiplier = speed.new_multiplier = multiplier_at(cuts, old);
        const std::vector<SteadyCut> cases = cases_of(cuts[0], kFewCases);
        const auto probability = [&](double rpm) {
            return cases.empty() ? std::nullopt
                                 : std::optional(probability_of_chatter(cases, rpm, cuts[0].axial_depth_mm));
        };
        speed.old_probability = speed.new_probability = probability(old);
        if (speed.is_stable()) continue;
        auto speeds = default_speeds(cuts[0]).speeds_rpm();
        if (!speeds) continue;
        std::erase_if(*speeds, [&](double rpm) { return rpm > speed.most_rpm; });
        std::vector<double> multipliers(speeds->size());
        parallel(speeds->size(), [&](std::size_t k) { multipliers[k] = multiplier_at(cuts, (*speeds)[k]); });
        double least = speed.old_multiplier;
        for (const double multiplier : multipliers) least = std::min(least, multiplier);
        if (speed.old_multiplier <= least + kAlike) continue;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < speeds->size(); ++k) {
            const double away = std::abs((*speeds)[k] / old - 1);
            if (multipliers[k] > least + kAlike || !(away < nearest)) continue;
            nearest = away;
            speed.new_rpm = (*speeds)[k];
            speed.new_multiplier = multipliers[k];
        }
        speed.new_probability = probability(speed.new_rpm);
    }
    return found;
}

}  // namespace tribo::session
