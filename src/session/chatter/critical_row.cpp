// SPDX-License-Identifier: MIT
#include "session/chatter/critical_row.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text/limit_text.hpp"

namespace tribo::session {
namespace {

constexpr std::size_t kBatch = 512;         // rows that are computed at once
constexpr std::size_t kBandsToCompare = 4;  // enough to tell which row is worse

struct Row {
    std::size_t cutter;
    double spindle_rpm, feed_per_tooth_mm, start_s, lasts_s;
    int line;
    milling::ToolFrame frame;
    std::vector<milling::EngagementBand> bands;
};

// Rows whose borders differ by less are one for the search.
constexpr double kRad = 1e-3, kMm = 1e-3;

bool alike(const Row& a, const Row& b) {
    if (a.cutter != b.cutter || a.spindle_rpm != b.spindle_rpm || a.bands.size() != b.bands.size() ||
        length(a.frame.x - b.frame.x) > kRad || length(a.frame.z - b.frame.z) > kRad)
        return false;
    return std::equal(a.bands.begin(), a.bands.end(), b.bands.begin(), [](const auto& p, const auto& q) {
        return std::abs(p.z0_mm - q.z0_mm) < kMm && std::abs(p.z1_mm - q.z1_mm) < kMm &&
               std::abs(p.entry_rad - q.entry_rad) < kRad && std::abs(p.exit_rad - q.exit_rad) < kRad;
    });
}

class Search {
  public:
    Search(const job::Job& job, const MillSetup& setup, const ParallelFor& parallel)
        : job_(job), setup_(setup), parallel_(parallel) {}

    void add(Row row) {
        ++rows_;
        if (!batch_.empty() && alike(batch_.back(), row)) {
            batch_.back().lasts_s += row.lasts_s;
            return;
        }
        batch_.push_back(std::move(row));
        if (batch_.size() == kBatch) compute();
    }
    void compute() {
        std::vector<double> multipliers(batch_.size());
        parallel_(batch_.size(), [&](std::size_t n) {
            const SteadyCut cut = cut_of(batch_[n], kBandsToCompare);
            const double depth = cut.axial_depth_mm;
            // What is too slow to be computed counts as bad, and is said to be so.
            multipliers[n] = cut.spindle_rpm < cut.least_rpm(depth)
                                 ? std::numeric_limits<double>::max()
                                 : cut.at(cut.spindle_rpm, depth).multiplier;
        });
        for (std::size_t n = 0; n < batch_.size(); ++n) {
            // Of rows that chatter alike the one that lasts longest, not one on the way into the cut.
            constexpr double kAlike = 1.01;
            const double m = multipliers[n];
            const bool longer = worst_ && m * kAlike >= most_ && batch_[n].lasts_s > worst_->lasts_s;
            if (!worst_ || m > kAlike * most_ || longer) worst_ = batch_[n];
            most_ = std::max(most_, m);
        }
        batch_.clear();
    }
    std::size_t rows() const { return rows_; }
    SteadyCut worst() const { return cut_of(*worst_, kMostBands); }

  private:
    SteadyCut cut_of(const Row& row, std::size_t bands) const {
        SteadyCut cut;
        cut.cutter = setup_.cutters[row.cutter];
        cut.coefficients = setup_.coefficients;
        cut.modes = modes_in(row.frame, job_.modes);
        cut.bands = with_fewer_bands(row.bands, bands);
        cut.axial_depth_mm = milling::hull({row.bands, {}}).axial_depth_mm;
        cut.spindle_rpm = row.spindle_rpm;
        cut.feed_per_tooth_mm = row.feed_per_tooth_mm;
        cut.line = row.line;
        cut.t_s = row.start_s;
        cut.rows = rows_;
        return cut;
    }

    const job::Job& job_;
    const MillSetup& setup_;
    const ParallelFor& parallel_;
    std::vector<Row> batch_;
    std::optional<Row> worst_;
    double most_ = 0;
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

std::vector<milling::EngagementBand> with_fewer_bands(std::vector<milling::EngagementBand> bands,
                                                      std::size_t most) {
    while (bands.size() > most) {
        std::size_t low = 0, high = 0;
        double least = std::numeric_limits<double>::max();
        for (std::size_t a = 0; a < bands.size(); ++a) {
            for (std::size_t b = 0; b < bands.size(); ++b) {
                if (bands[a].z1_mm != bands[b].z0_mm) continue;
                // By the area that changes sides.
                const double apart = std::abs(bands[a].entry_rad - bands[b].entry_rad) +
                                     std::abs(bands[a].exit_rad - bands[b].exit_rad);
                const double share =
                    std::min(bands[a].z1_mm - bands[a].z0_mm, bands[b].z1_mm - bands[b].z0_mm);
                if (apart * share >= least) continue;
                least = apart * share;
                low = a;
                high = b;
            }
        }
        if (low == high) return bands;  // none stands on another
        milling::EngagementBand& below = bands[low];
        const milling::EngagementBand& above = bands[high];
        const double share = (above.z1_mm - above.z0_mm) / (above.z1_mm - below.z0_mm);
        below.entry_rad += share * (above.entry_rad - below.entry_rad);
        below.exit_rad += share * (above.exit_rad - below.exit_rad);
        below.z1_mm = above.z1_mm;
        bands.erase(bands.begin() + static_cast<std::ptrdiff_t>(high));
    }
    return bands;
}

Result<SteadyCut> critical_row(const job::LoadedJob& loaded, MillSetup setup, const CutPlace& place,
                               const ParallelFor& parallel,
                               const std::function<bool(double fraction)>& progress, Warnings& warnings) {
    if (auto good = check_modes(loaded.job); !good) return std::unexpected(good.error());
    const std::string& file = loaded.program.source;
    MillSession session(std::move(setup), parallel, progress);
    Search search(loaded.job, session.setup(), parallel);
    std::size_t tilted = 0;
    int tilted_line = 0;
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce&) {
        if (row.engagement.bands.empty()) return;
        if (place.line && row.line != *place.line) return;
        if (place.t_s && (row.start_s > *place.t_s || row.end_s <= *place.t_s)) return;
        constexpr double kUpright = 1e-9;
        if (!loaded.program.machine.empty() && length(cross(row.pose.frame.z, {0, 0, 1})) > kUpright) {
            ++tilted;
            tilted_line = row.line;
            return;
        }
        search.add({row.cutter, row.spindle_rpm, row.feed.across_mm, row.start_s, row.duration_s(), row.line,
                    row.pose.frame, row.engagement.bands});
    };
    sinks.progress = progress;
    session.run(sinks);
    search.compute();
    if (search.rows() == 0 && tilted > 0)
        return fail_at(file, tilted_line, 0, "the machine tilts the tool in every row of the cut in question",
                       "name a cut of an upright tool, or remove the machine");
    if (search.rows() == 0) return nothing_cut(file, place);
    if (tilted > 0)
        warnings.push_back({file, tilted_line,
                            std::to_string(tilted) + " rows were left out: the machine tilts "
                                                     "the tool in them"});
    return search.worst();
}

}  // namespace tribo::session
