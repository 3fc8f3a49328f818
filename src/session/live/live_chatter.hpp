// SPDX-License-Identifier: MIT
// Chatter as a viewer of a live mill sees it: what bends, the multipliers of the rows, and the chart of the
// cut at the clock. All is computed in slices, so that no picture waits for it.
#pragma once

#include "session/live/chart_of_cut.hpp"
#include "session/live/live_cut.hpp"

namespace tribo::session {

class LiveChatter {
  public:
    // The setup has modes, and must outlive this object.
    LiveChatter(const MillSetup& setup, const CutChange& change);

    // All multipliers are void. Those from `clock_row` on come first.
    void set_change(const CutChange& change, std::size_t clock_row);
    // Computes a slice: the row at the time first, then the rows from the one at the last change on, then
    // those before, then the chart; at least one multiplier or point, more while has_time is true. `dt_s`:
    // since the last call, of the viewer.
    void compute(const LiveCut& cut, double t_s, double dt_s, const std::function<bool()>& has_time);
    // Sends what is new of the rows that were sent, and the chart.
    void show(const LiveCut& cut, const protocol::FrameSink& frames);

    // Of the row that is cut at this time.
    std::optional<protocol::LiveChatterNow> now(const LiveCut& cut, double t_s) const;
    // Of a row, above 0; absent where it has none, or is not computed yet.
    std::optional<double> multiplier(std::size_t row) const {
        if (row >= rows_.size() || !(rows_[row].multiplier > 0)) return std::nullopt;
        return rows_[row].multiplier;
    }
    // What bends, with the change.
    protocol::LiveBending bending() const;

  private:
    // Multiplier of a row; kUnknown: not computed. 0: it has none.
    static constexpr float kUnknown = -1;
    // Rows [first, last).
    struct Range {
        std::size_t first, last;
    };

    void compute_row(std::span<const milling::CutRow> rows, std::size_t n);
    // Rows n ... last - 1 as far as there is time. Returns the first one that is left.
    std::size_t compute_rows(std::span<const milling::CutRow> rows, std::size_t n, std::size_t last,
                             const std::function<bool(std::size_t work)>& may_go_on);
    void is_new(std::size_t row);

    const MillSetup& setup_;
    std::vector<double> fastest_rpm_;  // of each cutter, with the highest override
    CutChange change_;
    std::vector<protocol::LiveChatter> rows_;
    // Rows from the one at the last change on, and before it: the next ones to compute.
    std::size_t after_ = 0, before_ = 0, clock_row_ = 0;
    std::optional<std::size_t> alike_;  // the row whose multiplier was computed last
    std::vector<Range> new_;            // not sent yet
    int times_anew_ = 0;                // the rows were sent anew, seen last
    ChartOfCut chart_;
};

}  // namespace tribo::session
