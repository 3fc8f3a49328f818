// SPDX-License-Identifier: MIT
#include "session/chatter/probability.hpp"

#include <algorithm>
#include <cassert>

#include "base/limits.hpp"
#include "session/chatter/row_stability.hpp"
#include "sweep/spread_factors.hpp"

namespace tribo::session {
namespace {

milling::CuttingCoefficients times(double factor, const milling::CuttingCoefficients& k) {
    return {factor * k.ktc, factor * k.krc, factor * k.kac, factor * k.kte, factor * k.kre, factor * k.kae};
}

}  // namespace

std::vector<SteadyCut> cases_of(const SteadyCut& cut, std::size_t count) {
    const bool some = std::ranges::any_of(cut.modes, [](const auto& mode) { return mode.spread.any(); });
    if (!some && cut.force_low_factor == cut.force_high_factor) return {};
    std::vector<SteadyCut> cases(count, cut);
    std::size_t value = 0;
    const sweep::SpreadFactors force(count, value++, cut.force_low_factor, cut.force_high_factor);
    for (std::size_t n = 0; n < count; ++n) cases[n].coefficients = times(force.at(n), cut.coefficients);
    const double most_damping = kLimits.mode_damping.range.max;
    std::size_t estimate = 0;  // the first value of the estimated modes
    for (std::size_t m = 0; m < cut.modes.size(); ++m) {
        const dynamics::Mode& mode = cut.modes[m];
        std::size_t first = value;
        if (mode.estimated && estimate > 0) {
            first = estimate;
        } else {
            value += 3;
            if (mode.estimated) estimate = first;
        }
        const sweep::SpreadFactors frequency(count, first, mode.spread.frequency),
            damping(count, first + 1, mode.spread.damping),
            stiffness(count, first + 2, mode.spread.stiffness);
        for (std::size_t n = 0; n < count; ++n) {
            dynamics::Mode& changed = cases[n].modes[m];
            changed.frequency_hz *= frequency.at(n);
            changed.damping_ratio = std::min(most_damping, changed.damping_ratio * damping.at(n));
            changed.stiffness_n_per_mm *= stiffness.at(n);
        }
    }
    return cases;
}

double probability_of_chatter(std::span<const SteadyCut> cases, double spindle_rpm, double axial_depth_mm) {
    assert(!cases.empty());
    const auto chatters = [&](const SteadyCut& c) {
        return c.at(spindle_rpm, axial_depth_mm).multiplier > 1;
    };
    return static_cast<double>(std::ranges::count_if(cases, chatters)) / static_cast<double>(cases.size());
}

std::optional<double> chatter_probability(const SteadyCut& cut, std::size_t count) {
    const std::vector<SteadyCut> cases = cases_of(cut, count);
    if (cases.empty()) return std::nullopt;
    return probability_of_chatter(cases, cut.spindle_rpm, cut.axial_depth_mm);
}

std::optional<double> chatter_probability(const ProgramChatter& chatter, const MillSetup& setup,
                                          std::size_t count) {
    if (chatter.worst() == nullptr) return std::nullopt;
    return chatter_probability(steady_cut_of(*chatter.worst(), setup, kRowBands), count);
}

std::size_t stable_depths(const SteadyCut& cut, double spindle_rpm, std::span<const double> depths_mm) {
    const auto is_stable = [&](std::size_t n) { return cut.at(spindle_rpm, depths_mm[n]).multiplier <= 1; };
    std::size_t stable = 0, step = 1;  // the first depths that are
    while (stable < depths_mm.size()) {
        const std::size_t asked = std::min(stable + step, depths_mm.size());
        if (is_stable(asked - 1)) {
            stable = asked;
            step *= 2;
            continue;
        }
        // Between `stable` and `asked`.
        for (std::size_t unstable = asked; unstable - stable > 1;) {
            const std::size_t middle = stable + (unstable - stable) / 2;
            (is_stable(middle - 1) ? stable : unstable) = middle;
        }
        break;
    }
    return stable;
}

sweep::Band limit_band_mm(std::span<const SteadyCut> cases, double spindle_rpm, const ParallelFor& parallel) {
    std::vector<double> depths_mm(cases.size());
    parallel(cases.size(), [&](std::size_t n) {
        depths_mm[n] = cases[n].limit(spindle_rpm).depth_mm.value_or(cases[n].cutter.length_mm);
    });
    return sweep::band_of(depths_mm);
}

void add_probability(const SteadyCut& cut, dynamics::StabilityChart& chart, const ParallelFor& parallel,
                     const std::function<bool(double fraction)>& may_go_on, std::size_t count) {
    SteadyCut coarse = cut;
    coarse.bands = with_fewer_bands(coarse.bands, kRowBands);
    const std::vector<SteadyCut> cases = cases_of(coarse, count);
    if (cases.empty()) return;
    const std::size_t depths = chart.depths_mm.size();
    chart.probability.assign(chart.points.size(), 0);
    parallel(chart.speeds_rpm.size(), [&](std::size_t speed) {
        double* const at = &chart.probability[speed * depths];
        std::vector<std::size_t> first(depths + 1);  // how many cases have their border before that depth
        const double share = static_cast<double>(speed) / static_cast<double>(chart.speeds_rpm.size());
        for (const SteadyCut& c : cases) {
            if (may_go_on && !may_go_on(share)) return;
            ++first[stable_depths(c, chart.speeds_rpm[speed], chart.depths_mm)];
        }
        std::size_t chattering = 0;
        for (std::size_t n = 0; n < depths; ++n) {
            chattering += first[n];
            at[n] = static_cast<double>(chattering) / static_cast<double>(cases.size());
        }
    });
}

}  // namespace tribo::session
