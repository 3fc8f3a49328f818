// SPDX-License-Identifier: MIT
// A milling job from the first move to the last: stock, engagement, force and time wired into one stream of
// rows. No files and no clocks: what comes out goes to sinks, what takes time is told to `progress`.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "field/carved/field_reader.hpp"
#include "milling/engagement/machining.hpp"
#include "milling/force/force.hpp"
#include "milling/force/row_force.hpp"
#include "milling/tool/coefficients.hpp"
#include "milling/tool/cutter.hpp"
#include "motion/path/program.hpp"
#include "motion/path/timing.hpp"
#include "session/cut/earlier_cuts.hpp"
#include "session/cut/mill_totals.hpp"

namespace tribo::session {

// Engagement that the job prescribes: it replaces the measured one wherever the tool cuts at all.
struct PrescribedEngagement {
    double entry_rad = 0, exit_rad = 0, axial_depth_mm = 0;
};

struct MillSetup {
    std::vector<motion::Move> moves;
    std::vector<std::size_t> cutter_of_move;  // index into `cutters`, one per move
    std::vector<double> rpm_of_move;          // one per move; > 0 for every feed move
    std::vector<milling::Cutter> cutters;
    milling::CuttingCoefficients coefficients;
    std::unique_ptr<const field::Shape> blank;
    double blank_volume_mm3 = 0;
    std::vector<EarlierCuts> earlier;  // carved before the session begins, in this order
    std::uint64_t stock_hash = 0;      // of all that decides the stock: blank, earlier cuts and frames
    std::vector<std::unique_ptr<const field::Shape>> fixtures;
    std::optional<PrescribedEngagement> engagement;
    motion::TimingOptions timing;
    std::shared_ptr<const motion::Schedule> schedule;  // of the moves; null: schedule_of() works it out
    double cell_mm = 0.25;
    std::optional<double> until_s;
    int harmonics =
        16;  // multiples of the tooth passing frequency (of the spindle's where teeth differ: times flutes)
};

// When each move runs: as prepare_mill() found it, or worked out for a setup that it has not made. Never
// null; motion::schedule() accepts the moves.
std::shared_ptr<const motion::Schedule> schedule_of(const MillSetup& setup);

struct MillSinks {
    // In the order of time, while cutting only; may be empty. References are valid during the call only.
    std::function<void(const milling::CutRow&, const milling::RowForce&)> row;
    std::function<bool(double fraction)> progress;  // now and then; false stops the run; may be empty
};

class MillSession {
  public:
    // The setup is as prepare_mill() checked it. Earlier cuts are carved here; `progress` is told as
    // MillSinks tell it, and where it stops them the session mills nothing.
    MillSession(MillSetup setup, ParallelFor parallel,
                const std::function<bool(double fraction)>& progress = {});
    ~MillSession();

    // Mills on to the end. False: stopped by `progress`; the stock is then somewhere in between.
    bool run(const MillSinks& sinks);
    // Mills on through the moves that begin before `t_s`, and those that share rows with the last of them:
    // what follows the session as it goes on.
    bool run_to(double t_s, const MillSinks& sinks);
    // Up to here it has milled.
    double milled_s() const;

    // Of the program, or until_s where that is sooner.
    double duration_s() const;
    // When each of setup().moves is where.
    const motion::Schedule& schedule() const;
    const field::CarvedField& stock() const;
    // The stock for another thread while this one mills: one at a time, gone before the session. Made and
    // destroyed on the milling thread (field/field_reader.hpp).
    std::unique_ptr<field::FieldReader> read_stock();
    const MillTotals& totals() const;
    const MillSetup& setup() const;

  private:
    class Run;
    std::unique_ptr<Run> run_;
};

}  // namespace tribo::session
