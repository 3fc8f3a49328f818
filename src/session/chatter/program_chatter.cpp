// SPDX-License-Identifier: MIT
#include "session/chatter/program_chatter.hpp"

#include <algorithm>

#include "session/chatter/simulated_cut.hpp"

namespace tribo::session {
namespace {

constexpr std::size_t kRowsAtOnce = 512;  // rows that are computed at once
constexpr double kLongestBatchS = 20;     // bounds the memory of traces

void add(ChatterTotals::Rows& rows, int line) {
    if (rows.count++ == 0) rows.line = line;
}

}  // namespace

Warnings warnings_of(const ChatterTotals& totals, const std::string& file) {
    Warnings warnings;
    const auto warn = [&](const ChatterTotals::Rows& rows, const std::string& cause) {
        if (rows.count > 0)
            warnings.push_back({file, rows.line, std::to_string(rows.count) + " rows " + cause});
    };
    if (totals.speed_varies) warnings.push_back({file, 0, kVariationWarning});
    warn(totals.on_bottom, "have no multiplier: only the flat bottom of the tool cuts in them");
    warn(totals.slow,
         "have no multiplier: the spindle is too slow for it, the modes vibrate too often in a turn");
    warn(totals.not_simulated, "have no vibration: their teeth follow each other too slowly");
    warn(totals.held,
         "vibrate by more than a tenth of the tool's diameter, where the equations end: the tool is held "
         "there");
    if (totals.surface_full_at_line)
        warnings.push_back(SurfaceRecorder::full_warning(file, *totals.surface_full_at_line));
    return warnings;
}

ProgramChatter::ProgramChatter(const MillSetup& setup, Options options, ParallelFor parallel, Sink sink)
    : setup_(setup),
      parallel_(std::move(parallel)),
      sink_(std::move(sink)),
      options_(options),
      recorder_(options.surface ? std::optional<SurfaceRecorder>(std::in_place, setup) : std::nullopt),
      simulation_(setup, options.traces, recorder_ ? &*recorder_ : nullptr) {}

void ProgramChatter::add(const milling::CutRow& row, const milling::RowForce& force) {
    if (count_ == batch_.size()) batch_.emplace_back();
    Row& copy = batch_[count_++];
    copy.cut = row;
    copy.force = force;
    copy.chatter = {};
    copy.trace.clear();
    lasts_s_ += row.duration_s();
    if (count_ == kRowsAtOnce || lasts_s_ > kLongestBatchS) compute();
}

void ProgramChatter::finish() {
    compute();
    totals_.speed_varies = setup_.variation.is_there();
    if (recorder_) totals_.surface_full_at_line = recorder_->full_at_line();
}

bool ProgramChatter::has_multiplier(const milling::CutRow& row) const {
    return !row.engagement.bands.empty();
}

void ProgramChatter::compute() {
    // Alike neighbours share the multiplier of the first one.
    std::vector<std::size_t> first_of(count_), firsts;
    for (std::size_t n = 0; n < count_; ++n) {
        const milling::CutRow& row = batch_[n].cut;
        if (!has_multiplier(row)) continue;
        if (firsts.empty() || !chatter_alike(batch_[firsts.back()].cut, row)) firsts.push_back(n);
        first_of[n] = firsts.back();
    }
    parallel_(1 + firsts.size(), [&](std::size_t task) {
        if (task > 0) {
            Row& row = batch_[firsts[task - 1]];
            row.chatter.stability = stability_of(row.cut, setup_);
            return;
        }
        for (std::size_t n = 0; n < count_; ++n) {
            Row& row = batch_[n];
            row.chatter.peak_displacement_mm =
                simulation_.run(row.cut, options_.traces ? &row.trace : nullptr);
            row.held = simulation_.was_held();
            if (options_.traces && row.chatter.peak_displacement_mm)
                row.chatter.vibration = {kVibrationHz, simulation_.first_sample(), row.trace};
        }
    });
    std::vector<double> lasts_s(count_);
    for (std::size_t n = 0; n < count_; ++n)
        if (has_multiplier(batch_[n].cut)) lasts_s[first_of[n]] += batch_[n].cut.duration_s();
    for (std::size_t n = 0; n < count_; ++n) {
        Row& row = batch_[n];
        if (has_multiplier(row.cut)) row.chatter.stability = batch_[first_of[n]].chatter.stability;
        if (row.chatter.stability && first_of[n] == n)
            worst_.add(row.cut, lasts_s[n], row.chatter.stability->multiplier);
        count(row);
        if (sink_) sink_(row.cut, row.force, row.chatter);
    }
    count_ = 0;
    lasts_s_ = 0;
}

void ProgramChatter::count(const Row& row) {
    const milling::CutRow& cut = row.cut;
    if (row.chatter.peak_displacement_mm) {
        totals_.largest_displacement_mm =
            std::max(totals_.largest_displacement_mm, *row.chatter.peak_displacement_mm);
    } else {
        session::add(totals_.not_simulated, cut.line);
    }
    if (row.held) session::add(totals_.held, cut.line);
    if (!row.chatter.stability) {
        session::add(cut.engagement.bands.empty() ? totals_.on_bottom : totals_.slow, cut.line);
        return;
    }
    const dynamics::Stability& s = *row.chatter.stability;
    if (!(s.multiplier > 1)) return;
    const bool again = !totals_.lines.empty() && totals_.lines.back().line == cut.line;
    if (!again) {
        totals_.lines.push_back({cut.line, cut.start_s, s.multiplier, s.chatter_hz});
    } else if (s.multiplier > totals_.lines.back().multiplier) {
        totals_.lines.back() = {cut.line, cut.start_s, s.multiplier, s.chatter_hz};
    }
}

}  // namespace tribo::session
