// SPDX-License-Identifier: MIT
// Chatter along a whole program: the multiplier and the vibration of each row.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "contact/force_trace.hpp"
#include "dynamics/stability.hpp"
#include "session/chatter/row_simulation.hpp"
#include "session/chatter/row_stability.hpp"

namespace tribo::session {

struct RowChatter {
    // Of the row as a steady cut; absent where it is not computed (ChatterTotals).
    std::optional<dynamics::Stability> stability;
    std::optional<contact::ForceTrace> vibration;  // what it adds to the force, if traces are asked for
    std::optional<double> peak_displacement_mm;    // of the tool against the part, at most; absent likewise
};

// A line of the program that chatters: its row with the largest multiplier.
struct ChatterLine {
    int line = 0;
    double t_s = 0, multiplier = 0, chatter_hz = 0;
};

struct ChatterTotals {
    std::vector<ChatterLine> lines;  // in the order of time; a line that comes again, again
    double largest_displacement_mm = 0;
    struct Rows {
        std::size_t count = 0;
        int line = 0;  // of the first one
    };
    Rows on_bottom;      // only the flat bottom cuts: no multiplier
    Rows slow;           // slower than SteadyCut::least_rpm(): no multiplier
    Rows not_simulated;  // slower than RowSimulation follows: no vibration
    Rows held;           // the tool moved farther than kLargestDisplacement
    bool speed_varies = false;
    std::optional<int> surface_full_at_line;  // SurfaceRecorder::full_at_line()
};

// Warnings about what is not computed.
Warnings warnings_of(const ChatterTotals& totals, const std::string& program_file);

// Takes the rows of a run and gives them on in the same order, each with its chatter, some hundred rows
// later. Same bits for any number of threads.
class ProgramChatter {
  public:
    using Sink = std::function<void(const milling::CutRow&, const milling::RowForce&, const RowChatter&)>;

    struct Options {
        bool traces = false;   // rows have their vibration, valid during the call of the sink
        bool surface = false;  // what the teeth leave is recorded
    };
    // The setup, with modes of each cutter, must outlive this object.
    ProgramChatter(const MillSetup& setup, Options options, ParallelFor parallel, Sink sink);

    void add(const milling::CutRow& row, const milling::RowForce& force);
    // Gives on the last rows.
    void finish();
    const ChatterTotals& totals() const { return totals_; }
    // What the teeth left, to be kept where it is still on the part. Once, after finish(), with
    // Options::surface.
    surface::ToothTraces take_surface() { return recorder_->take(); }
    // The row that chatters most; null if none has a multiplier.
    const milling::CutRow* worst() const { return worst_.row(); }

  private:
    struct Row {
        milling::CutRow cut;
        milling::RowForce force;
        RowChatter chatter;
        std::vector<std::array<float, 2>> trace;
        bool held = false;
    };
    bool has_multiplier(const milling::CutRow& row) const;
    void compute();
    void count(const Row& row);

    const MillSetup& setup_;
    ParallelFor parallel_;
    Sink sink_;
    Options options_;
    std::optional<SurfaceRecorder> recorder_;  // with options_.surface
    RowSimulation simulation_;
    std::vector<Row> batch_;  // the first count_ of them; the others keep their memory
    std::size_t count_ = 0;
    double lasts_s_ = 0;  // all of them
    ChatterTotals totals_;
    WorstRow worst_;
};

}  // namespace tribo::session
