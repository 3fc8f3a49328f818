// SPDX-License-Identifier: MIT
#include "app/feed/feed.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/exit.hpp"
#include "app/feed/edited_program.hpp"
#include "app/feed/feed_outputs.hpp"
#include "app/feed/stable_speeds.hpp"
#include "app/interrupt.hpp"
#include "app/outputs.hpp"
#include "app/progress.hpp"
#include "app/render/render_job.hpp"
#include "base/text/decimal.hpp"
#include "base/text/printable.hpp"
#include "files/machine_limits.hpp"
#include "job/program_file.hpp"
#include "motion/path/path.hpp"
#include "readers/nci/reader.hpp"
#include "readers/rewrite/feed_words.hpp"
#include "readers/rewrite/unrolled.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {
namespace {

std::string line_of(std::string_view text, int number) {
    std::size_t at = 0;
    for (int n = 1; n < number && at < text.size(); ++n)
        at = std::min(text.find('\n', at), text.size() - 1) + 1;
    return printable(text.substr(at, std::min(text.find_first_of("\r\n", at), text.size()) - at));
}

FileResult<readers::FeedLanguage> language_of(const job::Job& job, std::string_view text) {
    if (job.path.kind == job::PathKind::keyframes)
        return std::unexpected(FileFailure(Error{
            job.path.file, 0, 0, "keyframes have no feed words in blocks", "write the path as a program"}));
    if (readers::looks_like_nci(text))
        return std::unexpected(
            FileFailure(Error{job.path.file, 0, 0, "the feeds of an NCI file are parameters of its records",
                              "let Mastercam post it, and change the program"}));
    if (job.path.kind == job::PathKind::apt) return readers::FeedLanguage::apt;
    job::ProgramFileOptions told;
    told.dialect = job.path.dialect;
    switch (job::dialect_of_program(text, job.path.file, told)) {
        case readers::Dialect::siemens:
            return readers::FeedLanguage::siemens;
        case readers::Dialect::heidenhain:
            return readers::FeedLanguage::heidenhain;
        default:
            return readers::FeedLanguage::gcode;
    }
}

// Each line must run once, in the order of the text: then a feed word holds where it stands.
Result<void> check_order(const session::MillSetup& setup, const std::string& file, std::string_view text) {
    int last = 0;
    for (const motion::Move& move : setup.moves) {
        if (move.line < last) {
            return fail_at(file, move.line, 0,
                           "this line runs after line " + std::to_string(last) +
                               ", so a loop, a subprogram or a jump leads here: " + line_of(text, last),
                           "add --unroll, which writes each move as a block of its own");
        }
        last = move.line;
    }
    return {};
}

session::CutLimits targets_of(const FeedCall& call, const PreparedJob& loaded) {
    session::CutLimits limits = session::cut_limits(loaded.job, loaded.setup);
    const auto exact = [](double value, const char* flag) {
        return session::CutLimit{value, value, value, flag, false};
    };
    if (call.has_target()) limits.spindle.clear();
    for (session::ToolLimits& tool : limits.of_cutter) {
        const auto set = [&](session::LoadKind kind, const std::optional<double>& value, const char* flag) {
            std::optional<session::CutLimit>& limit = tool.most[session::index_of(kind)];
            if (call.has_target()) limit.reset();
            if (value) limit = exact(*value, flag);
        };
        set(session::LoadKind::force, call.force_n, "--force-n");
        set(session::LoadKind::torque, {}, "");
        set(session::LoadKind::power, call.power_w, "--power-w");
        set(session::LoadKind::stress, call.stress_n_per_mm2, "--stress");
        set(session::LoadKind::deflection, call.deflection_mm, "--deflection-mm");
        if (!call.chip_mm) continue;
        tool.least_chip = exact(call.chip_mm->first, "--chip-mm");
        tool.most[session::index_of(session::LoadKind::chip)] = exact(call.chip_mm->second, "--chip-mm");
    }
    return limits;
}

// False: interrupted.
bool run(session::MillSession& session, const session::LoadModel& model,
         const session::FeedPlanOptions& options, Progress& progress, const char* stage, FeedRun& result) {
    session::FeedPlan plan(model, session, options);
    session::MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
        plan.add(row, force);
        result.forces.add(force.peaks.peak_force_n, row.duration_s());
    };
    sinks.progress = [&](double fraction) {
        progress.update(stage, fraction);
        return !interrupted();
    };
    if (!session.run(sinks)) return false;
    result.blocks = plan.finish();
    result.totals = session.totals();
    return true;
}

// Refuses other moves. Returns the blocks, by number, that do not run at the feeds that were asked for.
Result<std::vector<std::size_t>> compare(const session::MillSetup& before, const session::MillSetup& after,
                                         const std::vector<session::BlockFeed>& blocks,
                                         const std::string& file) {
    const auto refuse = [&](int line, std::string cause) {
        return fail_at(
            file, line, 0, std::move(cause),
            "the feeds of this program cannot be changed in its text: write it without variables and cycles");
    };
    if (before.moves.size() != after.moves.size())
        return refuse(0, "with other feed words the program would move otherwise");
    std::vector<std::size_t> stubborn;
    auto block = blocks.begin();
    for (std::size_t n = 0; n < before.moves.size(); ++n) {
        const motion::Move &a = before.moves[n], &b = after.moves[n];
        const auto same_arc = [&] {
            if (a.arc.has_value() != b.arc.has_value()) return false;
            return !a.arc || (a.arc->centre_mm == b.arc->centre_mm && a.arc->normal == b.arc->normal &&
                              a.arc->turn_rad == b.arc->turn_rad);
        };
        const auto same_curve = [&] {
            if (a.quadratic.has_value() != b.quadratic.has_value()) return false;
            return !a.quadratic || (a.quadratic->tip_control_mm == b.quadratic->tip_control_mm &&
                                    a.quadratic->axis_control == b.quadratic->axis_control);
        };
        if (a.kind != b.kind || !(a.start == b.start) || !(a.end == b.end) || !same_arc() || !same_curve() ||
            a.tool != b.tool || a.spindle_rpm != b.spindle_rpm)
            return refuse(a.line, "with other feed words this line would move otherwise");
        while (block != blocks.end() && block->end_move <= n) ++block;
        if (a.kind != motion::MoveKind::feed) continue;
        const double factor =
            block == blocks.end() || readers::keeps_feed(block->factor()) ? 1 : block->factor();
        const double is =
            a.duration_s > 0 ? a.duration_s / b.duration_s : b.feed_mm_per_min / a.feed_mm_per_min;
        // Rounding, and feeds that hold on.
        constexpr double kRounding = 0.004;
        if (factor == 1 ? std::abs(is - 1) < 1e-9
                        : is <= factor * (1 + 1e-9) && is >= factor * (1 - readers::kFeedReuse - kRounding))
            continue;
        if (block == blocks.end() || factor == 1)
            return refuse(a.line, "this line would run at " + format_digits(is, 4) + " times its feed");
        const auto number = static_cast<std::size_t>(block - blocks.begin());
        if (stubborn.empty() || stubborn.back() != number) stubborn.push_back(number);
    }
    return stubborn;
}

std::vector<readers::LineFeed> line_feeds(const std::vector<session::BlockFeed>& blocks) {
    std::vector<readers::LineFeed> feeds;
    for (const session::BlockFeed& block : blocks) {
        // Two runs of a line follow each other only where its tool changes within.
        if (!feeds.empty() && feeds.back().line == block.line) {
            feeds.back().factor = std::min(feeds.back().factor, block.factor());
        } else {
            feeds.push_back({block.line, block.factor()});
        }
    }
    return feeds;
}

struct Rewritten {
    std::string text;
    session::MillSetup setup;  // of this text
};

// Feeds that do not stand in feed words, as those of some cycles, stay as they are.
FileResult<Rewritten> rewrite(const FeedCall& call, const session::MillSetup& before, const std::string& text,
                              readers::FeedLanguage language, FeedAnswer& answer) {
    constexpr int kMostTries = 3;
    std::vector<session::BlockFeed>& blocks = answer.before.blocks;
    for (int tries = 0;; ++tries) {
        const std::vector<readers::LineFeed> feeds = line_feeds(blocks);
        answer.changed = static_cast<std::size_t>(
            std::ranges::count_if(feeds, [](const auto& f) { return !readers::keeps_feed(f.factor); }));
        auto written = readers::with_feeds(text, language, feeds, answer.program);
        if (!written) return std::unexpected(FileFailure(written.error()));
        auto edited = prepare_edited(call, answer.program, *written, before.cell_mm);
        if (!edited) return std::unexpected(edited.error());
        const auto stubborn = compare(before, *edited, blocks, answer.program);
        if (!stubborn) return std::unexpected(FileFailure(stubborn.error()));
        if (stubborn->empty()) return Rewritten{*std::move(written), *std::move(edited)};
        const int first = blocks[stubborn->front()].line;
        if (tries == kMostTries)
            return std::unexpected(
                FileFailure(Error{answer.program, first, 0, "the feed of this line follows no feed word",
                                  "write the program without cycles"}));
        answer.warnings.push_back({answer.program, first,
                                   "the feeds of " + std::to_string(stubborn->size()) +
                                       " blocks stand in no feed word, as that of a cycle does, and stay as "
                                       "they are; the first is here"});
        for (const std::size_t number : *stubborn) {
            blocks[number].new_mm_per_min = blocks[number].old_mm_per_min;
            blocks[number].reason = session::FeedReason::fixed;
        }
    }
}

// The program in plain words, in place of its text. It must read as the same moves.
FileResult<void> unroll(const FeedCall& call, readers::FeedLanguage language, PreparedJob& loaded,
                        std::string& text) {
    const std::string& file = loaded.job.path.file;
    if (language == readers::FeedLanguage::apt)
        return std::unexpected(FileFailure(Error{file, 0, 0, "--unroll writes no APT",
                                                 "let the CAM system write it without macros and copies"}));
    auto again = load_job(call.job, call.program, files::machine_limits());
    if (!again) return std::unexpected(again.error());
    readers::UnrollOptions options;
    options.language = language;
    job::ProgramFileOptions told;
    told.dialect = loaded.job.path.dialect;
    if (job::dialect_of_program(text, file, told) == readers::Dialect::fanuc)
        options.dialect = readers::GcodeDialect::fanuc;
    if (call.split_mm) options.longest_mm = *call.split_mm;
    auto unrolled = readers::unrolled_program(again->program, options);
    if (!unrolled) return std::unexpected(FileFailure(unrolled.error()));
    auto setup = prepare_edited(call, file, *unrolled, loaded.setup.cell_mm);
    if (!setup) return std::unexpected(setup.error());
    const auto length = [](const session::MillSetup& s) {
        double sum = 0;
        for (const motion::Move& move : s.moves) sum += motion::path_length_mm(move);
        return sum;
    };
    const double was = length(loaded.setup);
    constexpr double kRounding = 1e-9;
    if (std::abs(length(*setup) - was) > kRounding * was + kRounding ||
        (!call.split_mm && setup->moves.size() != loaded.setup.moves.size()))
        return std::unexpected(FileFailure(Error{
            file, 0, 0, "written in plain words the program would move otherwise", "leave --unroll out"}));
    loaded.setup = *std::move(setup);
    text = *std::move(unrolled);
    return {};
}

// Lowers the feed of each block whose load is above its limit though a lower feed would help. False: none is.
// The result must not depend on the old feeds: then the feed of a feed is the same.
bool lower_feeds_over(FeedAnswer& answer) {
    bool lowered = false;
    for (std::size_t n = 0; n < answer.after.blocks.size(); ++n) {
        session::BlockFeed& block = answer.before.blocks[n];
        const double ratio = answer.after.blocks[n].ratio;
        if (!is_over(ratio) || session::may_stay_over(block.reason)) continue;
        const bool kept = readers::keeps_feed(block.factor());
        block.new_mm_per_min /= ratio;
        // What is nearly the old feed would stay.
        if (kept && readers::keeps_feed(block.factor()))
            block.new_mm_per_min = 0.999 * readers::kFeedKeptBelow * block.old_mm_per_min;
        block.reason = session::FeedReason::load;
        lowered = true;
    }
    return lowered;
}

FileResult<void> make(const FeedCall& call, PreparedJob& loaded, std::string text, FeedAnswer& answer,
                      bool& stopped) {
    const std::string& file = loaded.job.path.file;
    const auto language = language_of(loaded.job, text);
    if (!language) return std::unexpected(language.error());
    if (call.unroll) {
        if (auto done = unroll(call, *language, loaded, text); !done) return done;
    }
    if (auto good = check_order(loaded.setup, file, text); !good)
        return std::unexpected(FileFailure(good.error()));
    const ParallelFor parallel = parallel_for_over(available_threads());
    if (call.stable) {
        auto done = use_stable_speeds(call, *language, parallel, loaded, text, answer);
        if (stopped = interrupted(); stopped || !done) return done;
    }
    const session::LoadModel model(loaded.setup, targets_of(call, loaded));
    session::FeedPlanOptions options{call.sure, loaded.job.machine.rapid_mm_per_min, true};
    Progress progress;
    // The rows must not depend on the feeds that the blocks have now.
    loaded.setup.join_moves = false;
    session::MillSession session(std::move(loaded.setup), parallel);
    if (stopped = !run(session, model, options, progress, "milling", answer.before); stopped) return {};

    // Here short moves share rows, as in a render: their load may be a little larger.
    constexpr int kMostPasses = 4;
    options.solve = false;
    for (int pass = 1;; ++pass) {
        auto written = rewrite(call, session.setup(), text, *language, answer);
        if (!written) return std::unexpected(written.error());
        session::MillSession again(std::move(written->setup), parallel);
        answer.after = {};
        if (stopped = !run(again, model, options, progress, "milling again", answer.after); stopped)
            return {};
        if (pass == kMostPasses || !lower_feeds_over(answer))
            return files::write_file(answer.file, written->text);
    }
}

}  // namespace

int feed(const FeedCall& call) {
    session::MillOptions options{call.resolution_mm, {}};
    auto loaded = prepare_job(call.job, call.program, options, {}, files::Pipes::refuse);
    if (!loaded) return report(loaded.error());
    const std::string file = loaded->job.path.file;
    const auto text = files::read_file(file, job::kLargestProgramBytes, files::Pipes::refuse);
    if (!text) return report(text.error());
    FeedAnswer answer;
    answer.program = file;
    answer.file = call.in_place ? file : call.out;
    if (!call.in_place) {
        if (auto good = check_outputs({answer.file}); !good) return report(good.error());
    }
    if (auto fits = check_memory(call.job, loaded->setup, {}, {}); !fits) return report(fits.error());
    report(loaded->warnings);
    bool stopped = false;
    auto made = make(call, *loaded, *text, answer, stopped);
    if (!made) return report(made.error());
    if (stopped || interrupted()) return interrupted_exit_code();
    report(answer.warnings);
    answer.warnings.insert(answer.warnings.begin(), loaded->warnings.begin(), loaded->warnings.end());
    if (call.json) {
        std::fputs(feed_json(call, answer).c_str(), stdout);
    } else {
        print(answer);
    }
    return std::fflush(stdout) == 0
               ? kDone
               : report(files::system_failure("standard output", "write", errno).error());
}

}  // namespace tribo::app
