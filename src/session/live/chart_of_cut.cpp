// SPDX-License-Identifier: MIT
#include "session/live/chart_of_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "session/chatter/advice.hpp"
#include "session/chatter/row_stability.hpp"

namespace tribo::session {
namespace {

constexpr std::size_t kMostSpeeds = 100, kDepths = 40, kFirstStride = 8, kPockets = 3;
// Speeds at which a depth is looked for, and how often it is halved.
constexpr std::size_t kProbed = 12;
constexpr int kHalvings = 9;
// A cut that differs by less has the same chart, for the eye.
constexpr double kAlikeRad = 0.03, kAlikeShare = 0.03;
// Beyond an override out of the chart, so much more of it.
constexpr double kMargin = 0.1;
constexpr double kFrameS = 0.25;

bool same_material(const CutChange& a, const CutChange& b) {
    if (a.coefficients.has_value() != b.coefficients.has_value()) return false;
    if (!a.coefficients) return true;
    const milling::CuttingCoefficients &k = *a.coefficients, &l = *b.coefficients;
    return k.ktc == l.ktc && k.krc == l.krc && k.kac == l.kac && k.kte == l.kte && k.kre == l.kre &&
           k.kae == l.kae;
}

bool alike(const milling::CutRow& a, const milling::CutRow& b) {
    if (chatter_alike(a, b)) return true;
    const milling::EngagementHull p = milling::hull({a.engagement.bands, {}}),
                                  q = milling::hull({b.engagement.bands, {}});
    return a.cutter == b.cutter && a.spindle_rpm == b.spindle_rpm &&
           std::abs(p.entry_rad - q.entry_rad) < kAlikeRad && std::abs(p.exit_rad - q.exit_rad) < kAlikeRad &&
           std::abs(p.axial_depth_mm - q.axial_depth_mm) < kAlikeShare * p.axial_depth_mm &&
           length(a.pose.frame.x - b.pose.frame.x) < kAlikeRad &&
           length(a.pose.frame.z - b.pose.frame.z) < kAlikeRad;
}

}  // namespace

SteadyCut changed_cut_of(const milling::CutRow& row, const MillSetup& setup, std::size_t most_bands,
                         const CutChange& change) {
    SteadyCut cut = steady_cut_of(row, setup, most_bands);
    cut.spindle_rpm *= change.speed_factor;
    cut.feed_per_tooth_mm *= change.chip_factor();
    if (change.coefficients) {
        cut.coefficients = *change.coefficients;
        cut.force_low_factor = change.force_low_factor;
        cut.force_high_factor = change.force_high_factor;
    }
    if (change.helix_deg) cut.cutter.helix_deg = *change.helix_deg;
    return cut;
}

bool ChartOfCut::is_for(const milling::CutRow& row, const CutChange& change) const {
    const double rpm = row.spindle_rpm * change.speed_factor;
    return of_ && of_->change.helix_deg == change.helix_deg && same_material(of_->change, change) &&
           rpm >= least_rpm_ && rpm <= to_rpm_ && alike(of_->row, row);
}

void ChartOfCut::want(const milling::CutRow& row, const CutChange& change) {
    const bool at_rest = stage_ == Stage::none || (stage_ == Stage::complete && !new_ && rest_s_ <= 0);
    if (at_rest && !is_for(row, change)) begin(row, change);
}

void ChartOfCut::begin(const milling::CutRow& row, const CutChange& change) {
    of_ = {row, change};
    CutChange without_override = change;
    without_override.speed_factor = without_override.feed_factor = 1;
    cut_ = changed_cut_of(row, setup_, kRowBands, without_override);
    const dynamics::ChartRange range = default_speeds(cut_);
    const double rpm = cut_.spindle_rpm * change.speed_factor;
    least_rpm_ = rpm < range.from_rpm ? (1 - kMargin) * rpm : range.from_rpm;
    from_rpm_ = std::max(least_rpm_, cut_.least_rpm(cut_.cutter.length_mm));
    to_rpm_ = rpm > range.to_rpm ? (1 + kMargin) * rpm : range.to_rpm;
    first_mm_.clear();
    probe_mm_ = 0;
    stage_ = Stage::depths;
}

void ChartOfCut::probe_depth(const std::function<bool(std::size_t work)>& may_go_on) {
    const double whole = cut_.cutter.length_mm;
    while (first_mm_.size() < kProbed) {
        if (!may_go_on(cut_.bands.size() * cut_.modes.size())) return;
        const double share = static_cast<double>(first_mm_.size()) / (kProbed - 1);
        probe_mm_ = probe_mm_ > 0 ? 2 * probe_mm_ : std::ldexp(whole, -kHalvings);
        const double rpm = from_rpm_ + share * (to_rpm_ - from_rpm_);
        if (probe_mm_ < whole && cut_.at(rpm, probe_mm_).multiplier <= 1) continue;
        first_mm_.push_back(probe_mm_);
        probe_mm_ = 0;
    }
    lay_out();
}

void ChartOfCut::lay_out() {
    const double most = chart_depth_mm(cut_, first_mm_);
    chart_ = {};
    for (std::size_t n = 0; n < kMostSpeeds; ++n)
        chart_.speeds_rpm.push_back(from_rpm_ +
                                    static_cast<double>(n) / (kMostSpeeds - 1) * (to_rpm_ - from_rpm_));
    for (std::size_t n = 1; n <= kDepths; ++n)
        chart_.depths_mm.push_back(most * static_cast<double>(n) / kDepths);
    chart_.points.resize(kMostSpeeds * kDepths);
    chart_.limits.resize(kMostSpeeds);
    done_.assign(kMostSpeeds, false);
    pockets_.clear();
    speed_ = depth_ = 0;
    stable_mm_ = 0;
    stride_ = kFirstStride;
    stage_ = Stage::points;
}

bool ChartOfCut::next_speed() {
    done_[speed_] = true;
    depth_ = 0;
    stable_mm_ = 0;
    while (done_[speed_]) {
        speed_ += stride_;
        if (speed_ < kMostSpeeds) continue;
        if (stride_ == 1) return false;
        stride_ /= 2;
        speed_ = 0;
    }
    return true;
}

void ChartOfCut::compute(const std::function<bool(std::size_t work)>& may_go_on) {
    if (stage_ == Stage::depths) probe_depth(may_go_on);
    while (stage_ == Stage::points && may_go_on(cut_.bands.size() * cut_.modes.size())) {
        const auto at = [&](double depth_mm) { return cut_.at(chart_.speeds_rpm[speed_], depth_mm); };
        const double depth_mm = chart_.depths_mm[depth_];
        const dynamics::Stability& found = chart_.points[speed_ * kDepths + depth_] = at(depth_mm);
        dynamics::DepthLimit& limit = chart_.limits[speed_];
        if (!limit.depth_mm && found.multiplier > 1)
            limit = dynamics::limit_between(at, stable_mm_, depth_mm, found);
        stable_mm_ = depth_mm;
        new_ = true;
        if (++depth_ == kDepths && !next_speed()) finish();
    }
}

void ChartOfCut::finish() {
    pockets_ = dynamics::safe_pockets(chart_, kPockets);
    stage_ = Stage::complete;
    rest_s_ = 0;
}

void ChartOfCut::show(const protocol::FrameSink& frames) {
    if (!new_ || rest_s_ > 0) return;
    new_ = false;
    rest_s_ = kFrameS;
    protocol::LiveChart told;
    told.from_rpm = chart_.speeds_rpm[0];
    told.step_rpm = (to_rpm_ - from_rpm_) / (kMostSpeeds - 1);
    told.step_mm = chart_.depths_mm[0];
    told.depths = kDepths;
    for (std::size_t n = 0; n < kMostSpeeds; ++n) {
        const auto& limit = chart_.limits[n].depth_mm;
        told.limits_mm.push_back(!done_[n] ? 0
                                 : limit   ? static_cast<float>(*limit)
                                           : std::numeric_limits<float>::quiet_NaN());
    }
    for (const dynamics::Stability& point : chart_.points)
        told.multipliers.push_back(static_cast<float>(point.multiplier));
    for (const dynamics::SafePocket& pocket : pockets_)
        told.pockets.push_back({pocket.spindle_rpm, pocket.depth_mm});
    std::vector<std::uint8_t> frame;
    protocol::write_frame(told, frame);
    frames(frame);
}

}  // namespace tribo::session
