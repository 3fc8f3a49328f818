// SPDX-License-Identifier: MIT
// The chart of speeds and depths of the cut at the clock of a live mill, computed point by point.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "dynamics/stability_chart.hpp"
#include "protocol/live_frame.hpp"
#include "session/chatter/steady_cut.hpp"
#include "session/cut/cut_record.hpp"

namespace tribo::session {

// The steady cut of a row with at most `most_bands` bands and a change.
SteadyCut changed_cut_of(const milling::CutRow& row, const MillSetup& setup, std::size_t most_bands,
                         const CutChange& change);

// About a hundred speeds by forty depths; some speeds first, then those between. The chart is that of the
// program's speed: an override of the spindle moves the point in it. A chart that is begun is finished before
// that of another cut begins, a moment later. One thread.
class ChartOfCut {
  public:
    // The setup must outlive this object.
    explicit ChartOfCut(const MillSetup& setup) : setup_(setup) {}

    // The cut at the clock. The chart stays while it has almost the same engagement and direction, and its
    // speed stands in it.
    void want(const milling::CutRow& row, const CutChange& change);
    void pass(double dt_s) { rest_s_ -= dt_s; }
    // Computes points while may_go_on is true, which is asked before each and told its
    // bands times modes.
    void compute(const std::function<bool(std::size_t work)>& may_go_on);
    // Sends what is new, a few times a second.
    void show(const protocol::FrameSink& frames);

    // All points are computed.
    bool is_complete() const { return stage_ == Stage::complete; }

  private:
    enum class Stage { none, depths, points, complete };
    struct Wanted {
        milling::CutRow row;
        CutChange change;
    };

    bool is_for(const milling::CutRow& row, const CutChange& change) const;
    void begin(const milling::CutRow& row, const CutChange& change);
    void probe_depth(const std::function<bool(std::size_t work)>& may_go_on);
    void lay_out();
    bool next_speed();  // false: all are done
    void finish();

    const MillSetup& setup_;
    std::optional<Wanted> of_;
    Stage stage_ = Stage::none;
    SteadyCut cut_;
    // The least speed may be lower than those that can be computed.
    double least_rpm_ = 0, from_rpm_ = 0, to_rpm_ = 0;
    // The first unstable one of depths that double, at some speeds.
    std::vector<double> first_mm_;
    double probe_mm_ = 0;
    dynamics::StabilityChart chart_;
    std::vector<dynamics::SafePocket> pockets_;
    std::vector<bool> done_;  // speeds
    std::size_t speed_ = 0, depth_ = 0, stride_ = 1;
    double stable_mm_ = 0;
    bool new_ = false;
    double rest_s_ = 0;  // until the next frame
};

}  // namespace tribo::session
