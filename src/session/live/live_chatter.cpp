// SPDX-License-Identifier: MIT
#include "session/live/live_chatter.hpp"

#include <algorithm>

#include "base/limits.hpp"
#include "session/chatter/row_stability.hpp"

namespace tribo::session {
namespace {

// Multipliers and points in one slice, each times its bands and the modes, at most: about two milliseconds.
constexpr std::size_t kMostWork = 60;
// Rows that are like the one before, for which the time is asked once.
constexpr std::size_t kAlikeRows = 64;

// Bands times modes: about what a multiplier costs.
std::size_t work_of(const milling::CutRow& row, const MillSetup& setup) {
    return std::min(row.engagement.bands.size(), kRowBands) * setup.modes(row.cutter).size();
}

}  // namespace

LiveChatter::LiveChatter(const MillSetup& setup, const CutChange& change)
    : setup_(setup), fastest_rpm_(setup.cutters.size(), 1), change_(change), chart_(setup) {
    const double most = kLimits.override_percent.range.max / 100;
    for (std::size_t n = 0; n < setup.moves.size(); ++n) {
        double& fastest = fastest_rpm_[setup.cutter_of_move[n]];
        fastest = std::max(fastest, most * setup.rpm_of_move[n]);
    }
}

void LiveChatter::set_change(const CutChange& change, std::size_t clock_row) {
    change_ = change;
    std::ranges::fill(rows_, protocol::LiveChatter{kUnknown, 0});
    after_ = clock_row_ = clock_row;
    before_ = 0;
    alike_.reset();
    new_.clear();
}

void LiveChatter::compute_row(std::span<const milling::CutRow> rows, std::size_t n) {
    const milling::CutRow& row = rows[n];
    is_new(n);
    if (row.engagement.bands.empty() || setup_.modes(row.cutter).empty()) {
        rows_[n] = {};
        return;
    }
    const auto found = stability_of(changed_cut_of(row, setup_, kRowBands, change_));
    rows_[n] = found ? protocol::LiveChatter{static_cast<float>(found->multiplier),
                                             static_cast<float>(found->chatter_hz)}
                     : protocol::LiveChatter{};
    alike_ = n;
}

void LiveChatter::is_new(std::size_t row) {
    if (!new_.empty() && new_.back().last == row) {
        ++new_.back().last;
    } else {
        new_.push_back({row, row + 1});
    }
}

std::size_t LiveChatter::compute_rows(std::span<const milling::CutRow> rows, std::size_t n, std::size_t last,
                                      const std::function<bool(std::size_t)>& may_go_on) {
    std::size_t alike = 0;
    for (; n < last; ++n) {
        if (rows_[n].multiplier != kUnknown) continue;
        if (alike_ && !rows[n].engagement.bands.empty() && chatter_alike(rows[*alike_], rows[n])) {
            if (++alike % kAlikeRows == 0 && !may_go_on(1)) return n;
            rows_[n] = rows_[*alike_];
            is_new(n);
            continue;
        }
        if (!may_go_on(work_of(rows[n], setup_))) return n;
        compute_row(rows, n);
    }
    return n;
}

void LiveChatter::compute(const LiveCut& cut, double t_s, double dt_s,
                          const std::function<bool()>& has_time) {
    const std::span<const milling::CutRow> rows = cut.record().rows();
    rows_.resize(rows.size(), {kUnknown, 0});
    std::size_t work = 0;
    const auto may_go_on = [&](std::size_t more) {
        const bool may = work == 0 || (work < kMostWork && has_time());
        if (may) work += std::max<std::size_t>(more, 1);
        return may;
    };
    const auto here = cut.row_cut_at(t_s);
    if (here && rows_[*here].multiplier == kUnknown && may_go_on(work_of(rows[*here], setup_)))
        compute_row(rows, *here);
    after_ = compute_rows(rows, after_, rows.size(), may_go_on);
    before_ = compute_rows(rows, before_, std::min(clock_row_, rows.size()), may_go_on);
    chart_.pass(dt_s);
    if (here && rows_[*here].multiplier > 0) chart_.want(rows[*here], change_);
    chart_.compute(may_go_on);
}

void LiveChatter::show(const LiveCut& cut, const protocol::FrameSink& frames) {
    if (times_anew_ != cut.times_anew()) {
        times_anew_ = cut.times_anew();
        new_.clear();
        for (std::size_t n = 0; n < rows_.size(); ++n)
            if (rows_[n].multiplier != kUnknown) is_new(n);
    }
    std::vector<std::uint8_t> frame;
    std::vector<Range> left;
    for (const Range& range : new_) {
        const std::size_t last = std::min(range.last, std::max(cut.rows_sent(), range.first));
        if (last > range.first) {
            const auto begin = rows_.begin();
            protocol::write_frame(protocol::LiveMultipliers{static_cast<std::uint32_t>(range.first),
                                                            {begin + static_cast<std::ptrdiff_t>(range.first),
                                                             begin + static_cast<std::ptrdiff_t>(last)}},
                                  frame);
            frames(frame);
        }
        if (last < range.last) left.push_back({last, range.last});
    }
    new_ = std::move(left);
    chart_.show(frames);
}

std::optional<protocol::LiveChatterNow> LiveChatter::now(const LiveCut& cut, double t_s) const {
    const auto here = cut.row_cut_at(t_s);
    if (!here) return std::nullopt;
    protocol::LiveChatterNow now;
    if (*here < rows_.size() && rows_[*here].multiplier != kUnknown) now.of = rows_[*here];
    const auto& bands = cut.record().rows()[*here].engagement.bands;
    now.axial_depth_mm = static_cast<float>(milling::hull({bands, {}}).axial_depth_mm);
    return now;
}

protocol::LiveBending LiveChatter::bending() const {
    protocol::LiveBending bending;
    bending.coefficients = change_.coefficients.value_or(setup_.coefficients);
    for (std::size_t n = 0; n < setup_.cutters.size(); ++n) {
        const std::span<const dynamics::Mode> modes = setup_.modes(n);
        protocol::LiveBendingCutter of{setup_.cutters[n], fastest_rpm_[n], {modes.begin(), modes.end()}};
        of.cutter.holder.clear();
        if (change_.helix_deg) of.cutter.helix_deg = *change_.helix_deg;
        bending.cutters.push_back(std::move(of));
    }
    return bending;
}

}  // namespace tribo::session
