// SPDX-License-Identifier: MIT
#include "app/feed/stable_speeds.hpp"

#include <algorithm>
#include <cmath>

#include "app/feed/edited_program.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "readers/rewrite/feed_words.hpp"
#include "readers/rewrite/speed_words.hpp"
#include "session/chatter/program_chatter.hpp"
#include "session/feed/feed_plan.hpp"

namespace tribo::app {
namespace {

// The advice for the setup, which comes back unchanged. Nothing: interrupted.
std::optional<SpeedAdvice> advice_for(PreparedJob& loaded, const ParallelFor& parallel) {
    Progress progress;
    session::MillSession session(std::move(loaded.setup), parallel);
    session::StableSpeedSearch search(session.setup());
    session::ProgramChatter chatter(
        session.setup(), {}, parallel,
        [&](const milling::CutRow& row, const milling::RowForce&, const session::RowChatter& of_row) {
            if (of_row.stability) search.add(row, of_row.stability->multiplier);
        });
    session::MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) { chatter.add(row, force); };
    sinks.progress = [&](double fraction) {
        progress.update("milling for speeds", fraction);
        return !interrupted();
    };
    if (!session.run(sinks)) return std::nullopt;
    chatter.finish();
    SpeedAdvice advice = advise_speeds(search, loaded, session.setup(), parallel);
    loaded.setup = session.release_setup();
    return advice;
}

// Of feed moves by their line, and whether each has the speed that it should.
struct Wanted {
    std::vector<readers::LineSpeed> speeds;
    std::vector<double> feeds;  // one per line of `speeds`
};

Wanted wanted_of(const session::MillSetup& setup, const std::vector<double>& factor_of_cutter) {
    Wanted wanted;
    for (std::size_t n = 0; n < setup.moves.size(); ++n) {
        const motion::Move& move = setup.moves[n];
        if (move.kind != motion::MoveKind::feed) continue;
        if (!wanted.speeds.empty() && wanted.speeds.back().line == move.line) continue;
        const double factor = factor_of_cutter[setup.cutter_of_move[n]];
        wanted.speeds.push_back({move.line, factor});
        wanted.feeds.push_back(factor * session::feed_of(move));
    }
    return wanted;
}

Result<void> check_speeds(const session::MillSetup& before, const session::MillSetup& after,
                          const std::vector<double>& factor_of_cutter, const std::string& file) {
    constexpr double kRounding = 1;  // of a whole number, rpm
    const std::string remedy = "give each tool a speed word of its own, behind its tool call";
    if (before.moves.size() != after.moves.size())
        return fail_at(file, 0, 0, "with other spindle speeds the program would move otherwise", remedy);
    for (std::size_t n = 0; n < before.moves.size(); ++n) {
        if (before.moves[n].kind != motion::MoveKind::feed) continue;
        const double wanted = factor_of_cutter[before.cutter_of_move[n]] * before.rpm_of_move[n];
        if (std::abs(after.rpm_of_move[n] - wanted) > kRounding)
            return fail_at(file, before.moves[n].line, 0,
                           "this line should run at " + std::to_string(std::lround(wanted)) +
                               " rpm, and no speed word is its own",
                           remedy);
    }
    return {};
}

}  // namespace

FileResult<void> use_stable_speeds(const FeedCall& call, readers::FeedLanguage language,
                                   const ParallelFor& parallel, PreparedJob& loaded, std::string& text,
                                   FeedAnswer& answer) {
    if (auto good = check_bends(loaded.job); !good) return std::unexpected(FileFailure(good.error()));
    auto advice = advice_for(loaded, parallel);
    if (!advice) return {};
    answer.speeds = *std::move(advice);
    std::vector<double> factors(loaded.setup.cutters.size(), 1);
    for (const session::StableSpeed& speed : answer.speeds.speeds)
        if (speed.is_better()) factors[speed.cutter] = speed.factor();
    if (std::ranges::all_of(factors, [](double factor) { return factor == 1; })) return {};

    const std::string& file = loaded.job.path.file;
    const Wanted wanted = wanted_of(loaded.setup, factors);
    auto faster = readers::with_speeds(text, language, wanted.speeds, file);
    if (!faster) return std::unexpected(FileFailure(faster.error()));
    auto setup = prepare_edited(call, file, *faster, loaded.setup.cell_mm);
    if (!setup) return std::unexpected(setup.error());
    if (auto good = check_speeds(loaded.setup, *setup, factors, file); !good)
        return std::unexpected(FileFailure(good.error()));

    // Feeds per turn and per tooth have followed the speed already.
    std::vector<readers::LineFeed> feeds;
    const Wanted now = wanted_of(*setup, std::vector<double>(factors.size(), 1));
    for (std::size_t n = 0; n < wanted.feeds.size(); ++n)
        feeds.push_back({wanted.speeds[n].line, wanted.feeds[n] / now.feeds[n]});
    auto fed = readers::with_feeds(*faster, language, feeds, file);
    if (!fed) return std::unexpected(FileFailure(fed.error()));
    setup = prepare_edited(call, file, *fed, loaded.setup.cell_mm);
    if (!setup) return std::unexpected(setup.error());
    const Wanted got = wanted_of(*setup, std::vector<double>(factors.size(), 1));
    for (std::size_t n = 0; n < std::min(got.feeds.size(), wanted.feeds.size()); ++n) {
        constexpr double kRounding = 0.02;
        if (std::abs(got.feeds[n] / wanted.feeds[n] - 1) < kRounding) continue;
        answer.warnings.push_back({file, wanted.speeds[n].line,
                                   "the feed of this line stands in no feed word and does not follow the new "
                                   "spindle speed; others may not, either"});
        break;
    }
    loaded.setup = *std::move(setup);
    text = *std::move(fed);
    return {};
}

}  // namespace tribo::app
