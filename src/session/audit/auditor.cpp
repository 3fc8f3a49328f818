// SPDX-License-Identifier: MIT
#include "session/audit/auditor.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/math.hpp"

namespace tribo::session {
namespace {

// A longer pause between two rows is a gap between cuts, s.
constexpr double kSameCutS = 1e-6;

double plunge_deg(const milling::CutRow& row) {
    const milling::ToolTravel& t = row.pose.travel;
    return t.down_mm > 0 ? math::atan2(t.down_mm, t.across_mm) * math::kDegPerRad : 0;
}

}  // namespace

Auditor::Auditor(const LoadModel& model, const MillSession& session, LineSink sink,
                 std::optional<double> until_s)
    : model_(model),
      session_(session),
      sink_(std::move(sink)),
      until_s_(until_s.value_or(session.duration_s())),
      runs_(session.setup(), session.schedule()) {}

void Auditor::open_until(double t_s) {
    const MillSetup& setup = session_.setup();
    while (const auto run = runs_.next(t_s)) {
        Open& open = open_.emplace_back(Open{*run, {}});
        open.tally.line = run->line;
        open.tally.cutter = setup.cutter_of_move[run->first_move];
        open.tally.spindle_rpm = setup.rpm_of_move[run->first_move];
        open.tally.start_s = run->start_s;
        open.tally.end_s = std::min(run->end_s, until_s_);
        for (std::size_t n = run->first_move; n < run->end_move; ++n) {
            if (setup.moves[n].kind != motion::MoveKind::feed) continue;
            const motion::MoveTiming& timing = session_.schedule().moves[n];
            const double end = std::min(timing.end_s, until_s_);
            if (!(end > timing.start_s)) continue;
            open.tally.feed_s += end - timing.start_s;
            open.tally.feed_mm += timing.length_mm * timing.path_fraction(end);
        }
    }
}

void Auditor::add(const milling::CutRow& row, const milling::RowForce& force,
                  std::optional<double> multiplier) {
    open_until(row.end_s);
    const double middle = 0.5 * (row.start_s + row.end_s);
    RowLoads loads = model_.loads(row, force.peaks, force.chip_mm);
    if (multiplier) model_.add_multiplier(row.cutter, *multiplier, loads);
    if (cases_) {
        case_ratios_.clear();
        for (const milling::ForcePeaks& peaks : cases_->peaks(row, force.peaks))
            case_ratios_.push_back(model_.loads(row, peaks, force.chip_mm).ratio);
    }
    const CutLimit& least = model_.limits().of_cutter[row.cutter].least_chip;
    const bool enters = row.start_s > last_end_s_ + kSameCutS;
    const double jump = force.peaks.peak_force_n - (enters ? 0 : last_peak_n_);
    last_end_s_ = row.end_s;
    last_peak_n_ = force.peaks.peak_force_n;
    bool first = true;
    for (Open& open : open_) {
        const double shared = open.run.shared_s(row);
        if (!(shared > 0)) continue;
        LoadTally& tally = open.tally;
        tally.add_peaks(loads, tally.line, std::max(row.start_s, tally.start_s));
        if (cases_) tally.add_cases(case_ratios_);
        tally.cutting_s += shared;
        tally.removed_mm3 += row.removed_mm3 * shared / row.duration_s();
        if (force.chip_mm < least.low) tally.thin.below_low_s += shared;
        if (force.chip_mm < least.value) tally.thin.below_value_s += shared;
        if (force.chip_mm < least.high) tally.thin.below_high_s += shared;
        tally.plunge_deg = std::max(tally.plunge_deg, plunge_deg(row));
        if (std::exchange(first, false)) {
            tally.jump_n = std::max(tally.jump_n, jump);
            if (enters) ++tally.entries;
        }
    }
    // No later row begins before this one's middle.
    while (!open_.empty() && open_.front().run.end_s < middle) close_front();
}

void Auditor::close_front() {
    LoadTally& line = open_.front().tally;
    const std::vector<MillCollision>& collisions = session_.totals().collisions;
    for (; collision_ < collisions.size() && collisions[collision_].t_s <= line.end_s; ++collision_)
        ++line.collisions;
    count(line);
    if (sink_) sink_(line);
    open_.pop_front();
}

void Auditor::count(LoadTally& line) {
    ++audit_.line_count;
    audit_.feed_s += line.feed_s;
    audit_.cutting_s += line.cutting_s;
    auto tool = std::ranges::find(audit_.tools, line.cutter, &LoadTally::cutter);
    if (tool == audit_.tools.end()) {
        audit_.tools.emplace_back();
        tool = audit_.tools.end() - 1;
        tool->cutter = line.cutter;
        tool->start_s = line.start_s;
    }
    tool->add(line);
    line.close_cases();
    for (std::size_t n = 0; n < kLoadKinds; ++n) {
        const RatioBand band = band_of(line, static_cast<LoadKind>(n), model_);
        if (band.low > 1) {
            ++audit_.lines[n].over;
        } else if (band.high > 1) {
            ++audit_.lines[n].undecided;
        }
    }
    const auto worst_ratio = [](const LoadTally& tally) {
        const auto kind = tally.worst();
        return kind ? tally.of(*kind).ratio : 0;
    };
    if (!(worst_ratio(line) > 0)) return;
    const auto place =
        std::ranges::upper_bound(audit_.worst, worst_ratio(line), std::greater<>(), worst_ratio);
    if (place == audit_.worst.end() && audit_.worst.size() == kWorstLines) return;
    audit_.worst.insert(place, line);
    if (audit_.worst.size() > kWorstLines) audit_.worst.pop_back();
}

Audit Auditor::finish() {
    open_until(until_s_);
    while (!open_.empty()) close_front();
    for (LoadTally& tool : audit_.tools) tool.close_cases();
    audit_.duration_s = until_s_;
    return std::move(audit_);
}

}  // namespace tribo::session
