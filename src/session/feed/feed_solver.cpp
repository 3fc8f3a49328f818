// SPDX-License-Identifier: MIT
#include "session/feed/feed_solver.hpp"

#include <algorithm>
#include <utility>

namespace tribo::session {
namespace {

// A ratio between 1 less this and 1 is as good as 1. Above 1 it may be by rounding.
constexpr double kClose = 1e-3, kRounding = 1e-6;
constexpr int kMostSteps = 30;
// So small a chip needs the force of the edges alone.
constexpr double kNoChip = 1e-6;

}  // namespace

FeedSolver::FeedSolver(const MillSetup& setup, const LoadModel& model, bool sure) : model_(model) {
    for (std::size_t n = 0; n < setup.cutters.size(); ++n) {
        forces_.emplace_back(setup.cutters[n], setup.coefficients);
        std::array<double, kLoadKinds>& scale = scale_.emplace_back();
        for (const LoadKind kind :
             {LoadKind::force, LoadKind::torque, LoadKind::power, LoadKind::stress, LoadKind::deflection})
            scale[index_of(kind)] = sure ? model.band(n, kind, 1).high : 1;
    }
}

double FeedSolver::ratio(const milling::CutRow& row, const milling::ForcePeaks& peaks) const {
    const RowLoads loads = model_.loads(row, peaks, 0);
    double most = 0;
    for (std::size_t n = 0; n < kLoadKinds; ++n)
        most = std::max(most, scale_[row.cutter][n] * loads.ratio[n]);
    return most;
}

double FeedSolver::ratio(const milling::CutRow& row, double factor) {
    milling::ForceModel& force = forces_[row.cutter];
    force.engage(row.engagement, factor * row.feed);
    return ratio(row, force.peaks());
}

double FeedSolver::largest_factor(const milling::CutRow& row, double now, double most) {
    double low = 0, high = 1, low_ratio = ratio(row, kNoChip), high_ratio = now;
    if (low_ratio > 1) return 0;
    while (high_ratio <= 1) {
        if (high >= most) return most;
        low = std::exchange(high, std::min(most, 2 * high));
        low_ratio = std::exchange(high_ratio, ratio(row, high));
    }
    // The chord of a convex function lies above it: its crossing is a feed that is small enough. The weight
    // of an end that stays is halved (Illinois), so that both ends move. Every third step halves the
    // interval: that finds a jump, too.
    double weighted = high_ratio;
    for (int step = 0; step < kMostSteps && low_ratio < 1 - kClose; ++step) {
        const double share = step % 3 == 2 ? 0.5 : (1 - low_ratio) / (weighted - low_ratio);
        const double factor = low + share * (high - low);
        const double there = ratio(row, factor);
        if (there <= 1 + kRounding) {
            low = factor;
            low_ratio = there;
            weighted = 1 + 0.5 * (weighted - 1);
        } else {
            high = factor;
            weighted = there;
        }
    }
    return std::min(low, most);
}

}  // namespace tribo::session
