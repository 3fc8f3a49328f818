// SPDX-License-Identifier: MIT
#include "session/chatter/critical_row.hpp"

#include <algorithm>
#include <limits>

#include "base/text/limit_text.hpp"
#include "session/chatter/row_stability.hpp"

namespace tribo::session {
namespace {

constexpr std::size_t kBatch = 512;  // rows that are computed at once

class Search {
  public:
    Search(const MillSetup& setup, const ParallelFor& parallel) : setup_(setup), parallel_(parallel) {}

    void add(const milling::CutRow& row) {
        ++rows_;
        if (!batch_.empty() && chatter_alike(batch_.back().row, row)) {
            batch_.back().lasts_s += row.duration_s();
            return;
        }
        batch_.push_back({row, row.duration_s()});
        if (batch_.size() == kBatch) compute();
    }
    void compute() {
        std::vector<double> multipliers(batch_.size());
        parallel_(batch_.size(), [&](std::size_t n) {
            const auto stability = stability_of(batch_[n].row, setup_);
            // What is too slow to be computed counts as bad, and is said to be so.
            multipliers[n] = stability ? stability->multiplier : std::numeric_limits<double>::max();
        });
        for (std::size_t n = 0; n < batch_.size(); ++n)
            worst_.add(batch_[n].row, batch_[n].lasts_s, multipliers[n]);
        batch_.clear();
    }
    std::size_t rows() const { return rows_; }
    SteadyCut worst() const {
        SteadyCut cut = steady_cut_of(*worst_.row(), setup_, kMostBands);
        cut.rows = rows_;
        return cut;
    }

  private:
    struct Stretch {  // rows that chatter alike
        milling::CutRow row;
        double lasts_s = 0;
    };

    const MillSetup& setup_;
    const ParallelFor& parallel_;
    std::vector<Stretch> batch_;
    WorstRow worst_;
    std::size_t rows_ = 0;
};

std::unexpected<Error> nothing_cut(const std::string& file, const CutPlace& place) {
    if (place.line)
        return fail_at(file, *place.line, 0, "this line cuts nothing with the edges along the cutter",
                       "name a line that cuts, or leave --line out for the most critical one");
    if (place.t_s) {
        const std::string cause =
            "at " + plain_number(*place.t_s) + " s the edges along the cutter cut nothing";
        return fail_at(file, 0, 0, cause, "name a time of a cut, or leave --t out for the most critical one");
    }
    return fail_at(file, 0, 0, "the program cuts nothing with the edges along the cutter",
                   "check stock and path with tribo render, or write [engagement]");
}

}  // namespace

Result<SteadyCut> critical_row(const job::LoadedJob& loaded, MillSetup setup, const CutPlace& place,
                               const ParallelFor& parallel,
                               const std::function<bool(double fraction)>& progress) {
    if (auto good = check_modes(loaded.job); !good) return std::unexpected(good.error());
    const std::string& file = loaded.program.source;
    MillSession session(std::move(setup), parallel, progress);
    Search search(session.setup(), parallel);
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce&) {
        if (row.engagement.bands.empty()) return;
        if (place.line && row.line != *place.line) return;
        if (place.t_s && (row.start_s > *place.t_s || row.end_s <= *place.t_s)) return;
        search.add(row);
    };
    sinks.progress = progress;
    session.run(sinks);
    search.compute();
    if (search.rows() == 0) return nothing_cut(file, place);
    return search.worst();
}

}  // namespace tribo::session
