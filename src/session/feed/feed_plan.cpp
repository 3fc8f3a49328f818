// SPDX-License-Identifier: MIT
#include "session/feed/feed_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/path/path.hpp"

namespace tribo::session {
namespace {

constexpr double kPerMinute = 60;

}  // namespace

double feed_of(const motion::Move& move) {
    return move.duration_s > 0 ? kPerMinute * motion::path_length_mm(move) / move.duration_s
                               : move.feed_mm_per_min;
}

std::string_view name_of(FeedReason reason) {
    switch (reason) {
        case FeedReason::air:
            return "cuts nothing";
        case FeedReason::load:
            return "load";
        case FeedReason::thick_chip:
            return "largest chip";
        case FeedReason::machine:
            return "machine";
        case FeedReason::acceleration:
            return "acceleration";
        case FeedReason::thin_chip:
            return "least chip";
        case FeedReason::fixed:
            return "no feed word";
        case FeedReason::edge:
            return "edge force";
    }
    return "";
}

bool may_stay_over(FeedReason reason) {
    return reason == FeedReason::thin_chip || reason == FeedReason::fixed || reason == FeedReason::edge;
}

FeedPlan::FeedPlan(const LoadModel& model, const MillSession& session, FeedPlanOptions options)
    : model_(model),
      session_(session),
      options_(options),
      solver_(session.setup(), model, options.sure),
      runs_(session.setup(), session.schedule()) {}

void FeedPlan::open_until(double t_s) {
    const MillSetup& setup = session_.setup();
    while (const auto run = runs_.next(t_s)) {
        Open& open = open_.emplace_back();
        open.run = *run;
        open.cutter = setup.cutter_of_move[run->first_move];
        open.block.line = run->line;
        open.block.first_move = run->first_move;
        open.block.end_move = run->end_move;
        for (std::size_t n = run->first_move; n < run->end_move; ++n) {
            if (setup.moves[n].kind != motion::MoveKind::feed) continue;
            if (!(open.block.old_mm_per_min > 0)) open.block.old_mm_per_min = feed_of(setup.moves[n]);
            open.block.length_mm += session_.schedule().moves[n].length_mm;
        }
        open.block.new_mm_per_min = open.block.old_mm_per_min;
    }
}

void FeedPlan::add(const milling::CutRow& row, const milling::RowForce& force) {
    open_until(row.end_s);
    const double ratio = solver_.ratio(row, force.peaks);
    for (Open& open : open_)
        if (open.run.shared_s(row) > 0) consider(open, row, force.chip_mm, ratio);
    // No later row begins before this one's middle.
    while (!open_.empty() && open_.front().run.end_s < 0.5 * (row.start_s + row.end_s)) close_front();
}

void FeedPlan::consider(Open& open, const milling::CutRow& row, double chip_mm, double ratio) {
    open.block.ratio = std::max(open.block.ratio, ratio);
    const double speed = row.feed_mm_per_s();
    if (!options_.solve || !(speed > 0)) return;
    open.chip_per_speed_s = std::max(open.chip_per_speed_s, chip_mm / speed);
    const double most = std::min(open.allowed_mm_per_s, options_.most_mm_per_min / kPerMinute) / speed;
    // Most rows allow what an earlier row of the block allowed.
    if (std::isfinite(most) && (ratio <= 1 && most <= 1 ? true : solver_.ratio(row, most) <= 1)) return;
    constexpr double kNoEnd = 1e6;
    const double factor = solver_.largest_factor(row, ratio, std::min(most, kNoEnd));
    if (factor == 0) {
        open.edge = true;
    } else if (factor < kNoEnd) {
        open.allowed_mm_per_s = std::min(open.allowed_mm_per_s, factor * speed);
    }
}

void FeedPlan::close_front() {
    Open& open = open_.front();
    if (open.block.old_mm_per_min > 0) {
        if (open.chip_per_speed_s > 0) decide(open);
        blocks_.push_back(open.block);
    }
    open_.pop_front();
}

void FeedPlan::decide(Open& open) const {
    const ToolLimits& limits = model_.limits().of_cutter[open.cutter];
    BlockFeed& block = open.block;
    const double old = block.old_mm_per_min / kPerMinute, machine = options_.most_mm_per_min / kPerMinute;
    double speed = open.allowed_mm_per_s;
    block.reason = FeedReason::load;
    const auto lower = [&](double to, FeedReason reason) {
        if (!(to < speed)) return;
        speed = to;
        block.reason = reason;
    };
    const std::optional<CutLimit>& most_chip = limits.of(LoadKind::chip);
    const double thick = most_chip
                             ? (options_.sure ? most_chip->low : most_chip->value) / open.chip_per_speed_s
                             : std::numeric_limits<double>::infinity();
    lower(thick, FeedReason::thick_chip);
    lower(machine, FeedReason::machine);
    const double thin = std::min({limits.least_chip.value / open.chip_per_speed_s, thick, machine});
    if (speed < thin && old > speed) {
        speed = std::min(old, thin);
        block.reason = FeedReason::thin_chip;
    }
    if (open.edge) {
        speed = std::min(speed, old);
        block.reason = FeedReason::edge;
    }
    if (std::isfinite(speed)) block.new_mm_per_min = kPerMinute * speed;
}

// What a block cannot reach between its neighbours is not asked for: v^2 <= v'^2 + 2 a s.
void FeedPlan::accelerate() {
    const double acceleration = session_.setup().timing.acceleration_mm_per_s2;
    if (!(acceleration > 0)) return;
    const auto limit = [&](BlockFeed& block, const BlockFeed& beside) {
        if (block.reason == FeedReason::air) return;
        const double speed = beside.new_mm_per_min / kPerMinute;
        const double most = kPerMinute * std::sqrt(speed * speed + 2 * acceleration * block.length_mm);
        if (!(block.new_mm_per_min > most)) return;
        block.new_mm_per_min = most;
        block.reason = FeedReason::acceleration;
    };
    for (std::size_t n = blocks_.size(); n-- > 1;)
        if (blocks_[n - 1].end_move == blocks_[n].first_move) limit(blocks_[n - 1], blocks_[n]);
    for (std::size_t n = 1; n < blocks_.size(); ++n)
        if (blocks_[n - 1].end_move == blocks_[n].first_move) limit(blocks_[n], blocks_[n - 1]);
}

std::vector<BlockFeed> FeedPlan::finish() {
    open_until(session_.duration_s());
    while (!open_.empty()) close_front();
    if (options_.solve) accelerate();
    return std::move(blocks_);
}

}  // namespace tribo::session
