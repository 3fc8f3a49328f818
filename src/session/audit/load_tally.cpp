// SPDX-License-Identifier: MIT
#include "session/audit/load_tally.hpp"

#include <algorithm>

namespace tribo::session {
namespace {

void raise(PeakLoad& peak, const PeakLoad& other) {
    const bool further = other.ratio > peak.ratio || (peak.ratio == 0 && other.value > peak.value);
    if (further) {
        peak.line = other.line;
        peak.t_s = other.t_s;
    }
    peak.value = std::max(peak.value, other.value);
    peak.ratio = std::max(peak.ratio, other.ratio);
}

}  // namespace

std::optional<LoadKind> LoadTally::worst() const {
    const auto most = std::ranges::max_element(peaks, {}, &PeakLoad::ratio);
    if (!(most->ratio > 0)) return std::nullopt;
    return static_cast<LoadKind>(most - peaks.begin());
}

void LoadTally::add_peaks(const RowLoads& loads, int at_line, double t_s) {
    for (std::size_t n = 0; n < kLoadKinds; ++n)
        raise(peaks[n], {loads.value[n], loads.ratio[n], at_line, t_s});
}

void LoadTally::add_cases(std::span<const std::array<double, kLoadKinds>> ratios) {
    cases.resize(ratios.size());
    for (std::size_t n = 0; n < ratios.size(); ++n)
        for (std::size_t kind = 0; kind < kLoadKinds; ++kind)
            cases[n][kind] = std::max(cases[n][kind], ratios[n][kind]);
}

void LoadTally::close_cases() {
    if (cases.empty()) return;
    std::vector<double> ratios(cases.size());
    bands.emplace();
    for (std::size_t kind = 0; kind < kLoadKinds; ++kind) {
        for (std::size_t n = 0; n < cases.size(); ++n) ratios[n] = cases[n][kind];
        (*bands)[kind] = sweep::band_of(ratios);
    }
    cases = {};
}

void LoadTally::add(const LoadTally& other) {
    end_s = other.end_s;
    feed_mm += other.feed_mm;
    feed_s += other.feed_s;
    cutting_s += other.cutting_s;
    removed_mm3 += other.removed_mm3;
    for (std::size_t n = 0; n < kLoadKinds; ++n) raise(peaks[n], other.peaks[n]);
    thin.below_low_s += other.thin.below_low_s;
    thin.below_value_s += other.thin.below_value_s;
    thin.below_high_s += other.thin.below_high_s;
    plunge_deg = std::max(plunge_deg, other.plunge_deg);
    jump_n = std::max(jump_n, other.jump_n);
    entries += other.entries;
    collisions += other.collisions;
    if (!other.cases.empty()) add_cases(other.cases);
}

RatioBand band_of(const LoadTally& tally, LoadKind kind, const LoadModel& model) {
    const double ratio = tally.of(kind).ratio;
    if (!tally.bands || !follows_force(kind)) return model.band(tally.cutter, kind, ratio);
    const sweep::Band& band = (*tally.bands)[index_of(kind)];
    return model.with_limit(tally.cutter, kind, {band.low, ratio, band.high});
}

}  // namespace tribo::session
