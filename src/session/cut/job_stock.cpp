// SPDX-License-Identifier: MIT
#include "session/cut/job_stock.hpp"

#include <utility>

#include "base/hash.hpp"
#include "session/cut/mill_setup.hpp"

namespace tribo::session {
namespace {

// The cuts of one earlier job, and the frame of the current job in the coordinates of the earlier one.
struct Link {
    EarlierCuts cuts;
    motion::WorkFrame frame;
};

// `frame` is given in the coordinates of `outer`. Returns it in the coordinates in which `outer` is given.
motion::WorkFrame composed(const motion::WorkFrame& outer, const motion::WorkFrame& frame) {
    return {outer.in_stock(frame.origin_mm), outer.direction_in_stock(frame.x),
            outer.direction_in_stock(frame.y), outer.direction_in_stock(frame.z)};
}

job::StockRecord record_of(const EarlierCuts& cuts, std::uint64_t stock_hash) {
    job::StockRecord record;
    record.stock = stock_hash;
    record.cutters = hash_of_cutters(cuts.cutters);
    record.moves = hash_of_moves(cuts);
    return record;
}

// Returns the difference as text for a message; empty if there is none.
std::string difference(const job::StockRecord& then, const job::StockRecord& now) {
    std::string text;
    const auto add = [&](bool differs, const char* what) {
        if (differs) text += (text.empty() ? "" : ", ") + std::string(what);
    };
    add(then.stock != now.stock, "the stock that it began with");
    add(then.cutters != now.cutters, "its cutters");
    add(then.moves != now.moves, "its path");
    return text;
}

std::uint64_t hash_of(const job::StockRecord& left, const motion::WorkFrame& frame) {
    Hash hash;
    hash.add(left.stock);
    hash.add(left.cutters);
    hash.add(left.moves);
    for (const Vec3 v : {frame.origin_mm, frame.x, frame.y, frame.z}) hash.add(v);
    return hash.value();
}

// Returns the cuts of an earlier job, in its own coordinates.
Result<EarlierCuts> planned_cuts(const job::EarlierJob& earlier, Warnings& warnings,
                                 std::uint64_t memory_bytes) {
    MillOptions options;
    options.memory_bytes = memory_bytes;
    if (earlier.source.record) options.until_s = earlier.source.record->until_s;
    auto setup = prepare_moves(earlier.job, earlier.program, options, warnings);
    if (!setup) return std::unexpected(setup.error());
    return planned_cuts(*setup);
}

// Refuses a render folder whose stock differs from that of its job now. `next` is the job that refers to the
// folder.
Result<void> check_record(const job::Job& next, const job::StockSource& source, const job::StockRecord& now) {
    const std::string changed = source.record ? difference(*source.record, now) : std::string();
    if (changed.empty()) return {};
    const job::JobStockFrom& from = *next.stock_from;
    return fail_at(next.file, from.line, from.column,
                   "'" + from.path + "' does not show what " + source.job + " (rendered by tribo " +
                       source.record->version + ") leaves now: changed since: " + changed,
                   "render it again, or name the job itself");
}

}  // namespace

Result<JobStock> stock_of(const job::LoadedJob& loaded, Warnings& warnings, std::uint64_t memory_bytes) {
    JobStock stock;
    stock.blank_volume_mm3 = loaded.blank.volume_mm3;
    stock.hash = loaded.blank.hash;
    motion::WorkFrame blank_frame;
    std::vector<Link> links;
    for (std::size_t n = loaded.earlier.size(); n-- > 0;) {
        const job::Job& next = n > 0 ? loaded.earlier[n - 1].job : loaded.job;
        auto cuts = planned_cuts(loaded.earlier[n], warnings, memory_bytes);
        if (!cuts) return std::unexpected(cuts.error());
        const job::StockRecord now = record_of(*cuts, stock.hash);
        if (auto same = check_record(next, loaded.earlier[n].source, now); !same)
            return std::unexpected(same.error());
        const motion::WorkFrame frame = next.setup.value_or(motion::WorkFrame{});
        stock.hash = hash_of(now, frame);
        links.push_back({*std::move(cuts), {}});
        blank_frame = composed(blank_frame, frame);
        for (Link& link : links) link.frame = composed(link.frame, frame);
    }
    stock.blank = job::shape_of(loaded.blank, blank_frame);
    for (Link& link : links) {
        for (motion::Move& move : link.cuts.moves) move = in_frame(move, link.frame);
        stock.earlier.push_back(std::move(link.cuts));
    }
    return stock;
}

job::StockRecord stock_record(const MillSetup& setup) {
    job::StockRecord record;
    record.stock = setup.stock_hash;
    record.cutters = hash_of_cutters(setup.cutters);
    record.moves = hash_of_planned_moves(setup);
    record.until_s = setup.until_s;
    return record;
}

}  // namespace tribo::session
