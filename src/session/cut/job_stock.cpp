// SPDX-License-Identifier: MIT
#include "session/cut/job_stock.hpp"

#include <algorithm>
#include <utility>

#include "base/hash.hpp"
#include "job/completion.hpp"
#include "session/cut/mill_setup.hpp"

namespace tribo::session {
namespace {

using motion::WorkFrame;

// The cuts of one job, and the frame of the job at hand in the coordinates of that one.
struct Link {
    EarlierCuts cuts;
    motion::WorkFrame frame;
};

struct Chain {
    job::Solid blank;
    motion::WorkFrame blank_frame;
    std::vector<Link> links;
    std::uint64_t hash = 0;
};

// `frame` stands in the coordinates of `outer`: the same frame in those that `outer` stands in.
motion::WorkFrame composed(const motion::WorkFrame& outer, const motion::WorkFrame& frame) {
    return {outer.in_stock(frame.origin_mm), outer.direction_in_stock(frame.x),
            outer.direction_in_stock(frame.y), outer.direction_in_stock(frame.z)};
}

job::StockRecord record_of(const EarlierCuts& cuts, std::uint64_t stock_hash) {
    job::StockRecord record;
    record.stock = stock_hash;
    record.cutters = hash_of_cutters(cuts);
    record.moves = hash_of_moves(cuts);
    return record;
}

// What differs, for a message; empty where nothing does.
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

class ChainReader {
  public:
    ChainReader(const JobFiles& files, Warnings& warnings) : files_(files), warnings_(warnings) {}

    Result<Chain> read(const job::Job& job) {
        if (!job.stock_from) return read_blank(job);
        open_.push_back({files_.identity(job.file), job.file});
        auto chain = read_earlier(job);
        open_.pop_back();
        return chain;
    }

  private:
    struct Open {
        std::string identity, file;
    };

    Result<Chain> read_blank(const job::Job& job) {
        auto blank = files_.solid(job.stock);
        if (!blank) return std::unexpected(blank.error());
        Chain chain;
        chain.hash = blank->hash;
        chain.blank = *std::move(blank);
        return chain;
    }

    Result<Chain> read_earlier(const job::Job& job) {
        const job::JobStockFrom& from = *job.stock_from;
        const auto refuse = [&](std::string cause, std::string remedy) {
            return fail_at(job.file, from.line, from.column, std::move(cause), std::move(remedy));
        };
        auto source = files_.source(from.path);
        if (!source) {
            if (!source.error().file.empty()) return std::unexpected(source.error());
            return refuse(source.error().cause, source.error().remedy);
        }
        const std::string identity = files_.identity(source->job);
        const auto again = std::find_if(open_.begin(), open_.end(),
                                        [&](const Open& open) { return open.identity == identity; });
        if (again != open_.end()) {
            std::string circle;
            for (auto open = again; open != open_.end(); ++open) circle += open->file + " -> ";
            return refuse("the job begins with the stock that it leaves itself: " + circle + again->file,
                          "let the first of the jobs begin with box_mm or mesh");
        }
        if (open_.size() > kLongestChain) {
            return refuse(
                "more than " + std::to_string(kLongestChain) + " jobs begin with each other's stock",
                "render an early one, and begin with mesh = \"machined.stl\" of its folder");
        }
        auto first = files_.job(source->job);
        if (!first) return std::unexpected(first.error());
        auto program = files_.program(*first);
        if (!program) return std::unexpected(program.error());
        warnings_.insert(warnings_.end(), program->warnings.begin(), program->warnings.end());
        if (auto done = job::complete_job(*first, *program, warnings_); !done)
            return std::unexpected(done.error());
        auto chain = read(*first);
        if (!chain) return chain;

        MillOptions options;
        if (source->record) options.until_s = source->record->until_s;
        auto setup = prepare_moves(*first, *program, options, warnings_);
        if (!setup) {
            Error error = setup.error();
            if (error.file.empty()) error.file = source->job;
            return std::unexpected(std::move(error));
        }
        EarlierCuts cuts = cuts_of(*setup);
        const job::StockRecord now = record_of(cuts, chain->hash);
        if (source->record) {
            const std::string changed = difference(*source->record, now);
            if (!changed.empty()) {
                return refuse("'" + from.path + "' does not show what " + source->job +
                                  " (rendered by tribo " + source->record->version +
                                  ") leaves now: changed since: " + changed,
                              "render it again, or name the job itself");
            }
        }
        chain->links.push_back({std::move(cuts), {}});
        const motion::WorkFrame frame = job.setup.value_or(motion::WorkFrame{});
        chain->blank_frame = composed(chain->blank_frame, frame);
        for (Link& link : chain->links) link.frame = composed(link.frame, frame);
        chain->hash = hash_of(now, frame);
        return chain;
    }

    const JobFiles& files_;
    Warnings& warnings_;
    std::vector<Open> open_;  // the jobs on the way back to the first
};

}  // namespace

Result<JobStock> read_stock(const job::Job& job, const JobFiles& files, Warnings& warnings) {
    auto chain = ChainReader(files, warnings).read(job);
    if (!chain) return std::unexpected(chain.error());
    JobStock stock;
    stock.blank_volume_mm3 = chain->blank.volume_mm3;
    stock.hash = chain->hash;
    stock.blank = in_frame(std::move(chain->blank), chain->blank_frame);
    for (Link& link : chain->links) {
        for (motion::Move& move : link.cuts.moves) move = in_frame(move, link.frame);
        stock.earlier.push_back(std::move(link.cuts));
    }
    return stock;
}

job::StockRecord stock_record(const MillSetup& setup, std::uint64_t stock_hash) {
    job::StockRecord record = record_of(cuts_of(setup), stock_hash);
    record.until_s = setup.until_s;
    return record;
}

}  // namespace tribo::session
