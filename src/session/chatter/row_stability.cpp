// SPDX-License-Identifier: MIT
#include "session/chatter/row_stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribo::session {
namespace {

// Borders of alike rows differ by less.
constexpr double kRad = 1e-3, kMm = 1e-3;

}  // namespace

SteadyCut steady_cut_of(const milling::CutRow& row, const MillSetup& setup, std::size_t most_bands) {
    SteadyCut cut;
    cut.cutter = setup.cutters[row.cutter];
    cut.coefficients = setup.coefficients;
    cut.force_low_factor = setup.force_low_factor;
    cut.force_high_factor = setup.force_high_factor;
    cut.modes = modes_in(row.pose.frame, head_frame(row, setup), setup.modes(row.cutter));
    cut.bands = with_fewer_bands(row.engagement.bands, most_bands);
    cut.axial_depth_mm = milling::hull({row.engagement.bands, {}}).axial_depth_mm;
    cut.spindle_rpm = row.spindle_rpm;
    cut.feed_per_tooth_mm = row.feed.across_mm;
    cut.variation = setup.variation;
    cut.line = row.line;
    cut.t_s = row.start_s;
    return cut;
}

std::optional<dynamics::Stability> stability_of(const milling::CutRow& row, const MillSetup& setup) {
    return stability_of(steady_cut_of(row, setup, kRowBands));
}

std::optional<dynamics::Stability> stability_of(const SteadyCut& cut) {
    const double depth = cut.axial_depth_mm;
    if (cut.spindle_rpm < cut.least_rpm(depth)) return std::nullopt;
    return cut.at(cut.spindle_rpm, depth);
}

void WorstRow::add(const milling::CutRow& row, double lasts_s, double multiplier) {
    constexpr double kAlike = 1.01;
    const bool longer = multiplier * kAlike >= most_ && lasts_s > lasts_s_;
    if (!row_ || multiplier > kAlike * most_ || longer) {
        row_ = row;
        lasts_s_ = lasts_s;
    }
    most_ = std::max(most_, multiplier);
}

bool chatter_alike(const milling::CutRow& a, const milling::CutRow& b) {
    const auto& bands = a.engagement.bands;
    const auto& others = b.engagement.bands;
    if (a.cutter != b.cutter || a.spindle_rpm != b.spindle_rpm || bands.size() != others.size() ||
        length(a.pose.frame.x - b.pose.frame.x) > kRad || length(a.pose.frame.z - b.pose.frame.z) > kRad)
        return false;
    return std::equal(bands.begin(), bands.end(), others.begin(), [](const auto& p, const auto& q) {
        return std::abs(p.z0_mm - q.z0_mm) < kMm && std::abs(p.z1_mm - q.z1_mm) < kMm &&
               std::abs(p.entry_rad - q.entry_rad) < kRad && std::abs(p.exit_rad - q.exit_rad) < kRad;
    });
}

std::vector<milling::EngagementBand> with_fewer_bands(std::vector<milling::EngagementBand> bands,
                                                      std::size_t most) {
    while (bands.size() > most) {
        std::size_t low = 0, high = 0;
        double least = std::numeric_limits<double>::max();
        for (std::size_t a = 0; a < bands.size(); ++a) {
            for (std::size_t b = 0; b < bands.size(); ++b) {
                if (bands[a].z1_mm != bands[b].z0_mm) continue;
                // By the area that changes sides.
                const double apart = std::abs(bands[a].entry_rad - bands[b].entry_rad) +
                                     std::abs(bands[a].exit_rad - bands[b].exit_rad);
                const double share =
                    std::min(bands[a].z1_mm - bands[a].z0_mm, bands[b].z1_mm - bands[b].z0_mm);
                if (apart * share >= least) continue;
                least = apart * share;
                low = a;
                high = b;
            }
        }
        if (low == high) return bands;  // none stands on another
        milling::EngagementBand& below = bands[low];
        const milling::EngagementBand& above = bands[high];
        const double share = (above.z1_mm - above.z0_mm) / (above.z1_mm - below.z0_mm);
        below.entry_rad += share * (above.entry_rad - below.entry_rad);
        below.exit_rad += share * (above.exit_rad - below.exit_rad);
        below.z1_mm = above.z1_mm;
        bands.erase(bands.begin() + static_cast<std::ptrdiff_t>(high));
    }
    return bands;
}

}  // namespace tribo::session
