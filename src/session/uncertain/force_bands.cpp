// SPDX-License-Identifier: MIT
#include "session/uncertain/force_bands.hpp"

#include <algorithm>

#include "milling/force/force.hpp"
#include "sweep/spread_factors.hpp"

namespace tribo::session {
namespace {

// Number of shares of the cases.
constexpr std::size_t kShares = 8;
// A cutter must cut with its whole circumference (milling/tool/cutter.hpp: run-out below the radius).
constexpr double kMostRunoutShare = 0.99;

// Numbers of what is off by itself (sweep/spread_factors.hpp): the force has that of cases_of(), where modes
// have those after it.
constexpr std::size_t kForceValue = 0, kFirstRunoutValue = 1'000'000;

bool has_uncertain_runout(const milling::Cutter& cutter) {
    return cutter.runout_mm > 0 && cutter.runout_spread > 0;
}

milling::ForcePeaks times(double factor, milling::ForcePeaks peaks) {
    peaks.mean_n = factor * peaks.mean_n;
    peaks.peak_n = factor * peaks.peak_n;
    for (double* value :
         {&peaks.peak_xy_n, &peaks.peak_force_n, &peaks.mean_torque_nmm, &peaks.peak_torque_nmm})
        *value *= factor;
    return peaks;
}

}  // namespace

bool has_spread(const MillSetup& setup) {
    const auto uncertain = [](const dynamics::Mode& mode) { return mode.spread.any(); };
    return setup.force_low_factor < setup.force_high_factor ||
           std::ranges::any_of(setup.cutters, has_uncertain_runout) ||
           std::ranges::any_of(
               setup.modes_of_cutter,
               [&](const auto& modes) { return std::ranges::any_of(modes, uncertain); });
}

ForceCases::ForceCases(const MillSetup& setup, std::size_t count, ParallelFor parallel,
                       const CutChange& change)
    : cutters_(changed_cutters(setup, change)),
      coefficients_(change.coefficients.value_or(setup.coefficients)),
      parallel_(std::move(parallel)),
      force_(count),
      runout_mm_(setup.cutters.size()),
      peaks_(count),
      scratch_(count) {
    const auto [low, high] = force_band(setup, change);
    const sweep::SpreadFactors force(count, kForceValue, low, high);
    for (std::size_t n = 0; n < count; ++n) force_[n] = force.at(n);
    for (std::size_t c = 0; c < cutters_.size(); ++c) {
        const milling::Cutter& cutter = cutters_[c];
        if (!has_uncertain_runout(cutter)) continue;
        const sweep::SpreadFactors factors(count, kFirstRunoutValue + c, cutter.runout_spread);
        for (std::size_t n = 0; n < count; ++n)
            runout_mm_[c].push_back(
                std::min(cutter.runout_mm * factors.at(n), kMostRunoutShare * cutter.radius_mm()));
    }
}

const std::vector<milling::ForcePeaks>& ForceCases::peaks(const milling::CutRow& row,
                                                          const milling::ForcePeaks& stated) {
    const std::vector<double>& runout_mm = runout_mm_[row.cutter];
    if (runout_mm.empty()) {
        for (std::size_t n = 0; n < count(); ++n) peaks_[n] = times(force_[n], stated);
        return peaks_;
    }
    parallel_(kShares, [&](std::size_t share) {
        milling::Cutter cutter = cutters_[row.cutter];
        const std::size_t last = count() * (share + 1) / kShares;
        for (std::size_t n = count() * share / kShares; n < last; ++n) {
            cutter.runout_mm = runout_mm[n];
            milling::ForceModel model(cutter, coefficients_);
            model.engage(row.engagement, row.feed);
            peaks_[n] = times(force_[n], model.peaks());
        }
    });
    return peaks_;
}

sweep::Band ForceCases::peak_force_n() {
    std::ranges::transform(peaks_, scratch_.begin(), &milling::ForcePeaks::peak_force_n);
    return sweep::band_of(scratch_);
}

ForceBands::ForceBands(const MillSetup& setup, std::size_t count, ParallelFor parallel)
    : cases_(setup, count, std::move(parallel)), totals_(count) {}

sweep::Band ForceBands::add(const milling::CutRow& row, const milling::ForcePeaks& stated) {
    const std::vector<milling::ForcePeaks>& peaks = cases_.peaks(row, stated);
    for (std::size_t n = 0; n < peaks.size(); ++n) totals_[n].add(row, peaks[n]);
    return cases_.peak_force_n();
}

ForceBands::Totals ForceBands::totals() const {
    const auto band = [&](double ForceTotals::* member) {
        std::vector<double> values;
        values.reserve(totals_.size());
        for (const ForceTotals& totals : totals_) values.push_back(totals.*member);
        return sweep::band_of(values);
    };
    return {band(&ForceTotals::mean_force_n), band(&ForceTotals::peak_force_n),
            band(&ForceTotals::peak_torque_nmm), band(&ForceTotals::peak_power_w)};
}

}  // namespace tribo::session
