// SPDX-License-Identifier: MIT
// Holds the rows of a run against the limits, line by line and tool by tool. Memory does not grow with the
// rows or the lines.
#pragma once

#include <deque>
#include <functional>
#include <vector>

#include "milling/force/row_force.hpp"
#include "session/audit/line_runs.hpp"
#include "session/audit/load_tally.hpp"
#include "session/uncertain/force_bands.hpp"

namespace tribo::session {

// The worst lines that are kept, and the lines of which the chart of a report is drawn.
inline constexpr std::size_t kWorstLines = 50;

// How many lines are over a limit for sure, and how many may be.
struct LineCounts {
    std::size_t over = 0, undecided = 0;
};

struct Audit {
    std::vector<LoadTally> tools;  // that cut or move, in the order of their first line
    std::vector<LoadTally> worst;  // lines, those first that are nearest to a limit; at most kWorstLines
    std::array<LineCounts, kLoadKinds> lines;  // in the order of LoadKind
    std::size_t line_count = 0;
    double duration_s = 0, feed_s = 0, cutting_s = 0;

    // Share of the time of feed moves in which nothing is cut.
    double air_share() const { return feed_s > 0 ? 1 - cutting_s / feed_s : 0; }
};

class Auditor {
  public:
    // Called once for each line that moves, in the order of time; a line that runs again comes again.
    using LineSink = std::function<void(const LoadTally& line)>;

    // Model and session must outlive this object. The session runs afterwards. `until_s`: of a session that
    // is not milled to its end; later lines do not count.
    Auditor(const LoadModel& model, const MillSession& session, LineSink sink,
            std::optional<double> until_s = {});

    // Bands come from the cases instead of the band of the force. Before the first row.
    void use(ForceCases cases) { cases_.emplace(std::move(cases)); }
    // The rows of MillSinks::row. `multiplier`: of a cut that may chatter, where it is known.
    void add(const milling::CutRow& row, const milling::RowForce& force, std::optional<double> multiplier);
    // After the run.
    Audit finish();

  private:
    struct Open {
        LineRun run;
        LoadTally tally;
    };
    void open_until(double t_s);
    void close_front();
    void count(LoadTally& line);

    const LoadModel& model_;
    const MillSession& session_;
    LineSink sink_;
    double until_s_;
    LineRuns runs_;
    std::deque<Open> open_;
    std::optional<ForceCases> cases_;
    std::vector<std::array<double, kLoadKinds>> case_ratios_;  // of the row
    Audit audit_;
    double last_end_s_ = -1, last_peak_n_ = 0;
    std::size_t collision_ = 0;  // the next one to be counted
};

}  // namespace tribo::session
