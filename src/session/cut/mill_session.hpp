// SPDX-License-Identifier: MIT
// Runs a milling job from the first move to the last. Stock, engagement, force and time give one stream of
// rows. No files and no clocks: rows go to sinks, and long work reports to `progress`.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "dynamics/mode.hpp"
#include "field/carved/field_reader.hpp"
#include "milling/engagement/machining.hpp"
#include "milling/force/force.hpp"
#include "milling/force/row_force.hpp"
#include "milling/tool/coefficients.hpp"
#include "milling/tool/cutter.hpp"
#include "motion/path/program.hpp"
#include "motion/path/timing.hpp"
#include "session/chatter/spindle_variation.hpp"
#include "session/cut/earlier_cuts.hpp"
#include "session/cut/kept_states.hpp"
#include "session/cut/mill_totals.hpp"

namespace tribo::session {

// Engagement prescribed by the job. It replaces the measured engagement wherever the tool cuts.
struct PrescribedEngagement {
    double entry_rad = 0, exit_rad = 0, axial_depth_mm = 0;
};

struct MillSetup {
    std::vector<motion::Move> moves;
    std::vector<std::size_t> cutter_of_move;  // index into `cutters`, one per move
    std::vector<double> rpm_of_move;          // one per move; > 0 for every feed move
    SpindleVariation variation;               // about all speeds; only vibrations in time follow it
    bool on_machine = false;                  // a machine moves tool and part by its joints
    std::vector<milling::Cutter> cutters;
    milling::CuttingCoefficients coefficients;
    // Factors on a force: the band in which the true one lies (milling/tool/materials.hpp).
    double force_low_factor = 1, force_high_factor = 1;
    // What bends with each cutter, as in job::Job; empty or one list per cutter.
    std::vector<std::vector<dynamics::Mode>> modes_of_cutter;
    std::unique_ptr<const field::Shape> blank;
    double blank_volume_mm3 = 0;
    std::vector<EarlierCuts> earlier;  // carved before the run, in this order
    std::uint64_t stock_hash = 0;      // hash of blank, earlier cuts and frames
    std::vector<std::unique_ptr<const field::Shape>> fixtures;
    std::uint64_t solid_bytes = 0;  // memory of blank and fixtures that are meshes, about
    std::optional<PrescribedEngagement> engagement;
    motion::TimingOptions timing;
    std::shared_ptr<const motion::Schedule> schedule;  // of the moves; null: schedule_of() computes it
    double cell_mm = 0.25;
    // Short moves of one feed share rows. False: rows do not depend on the feeds, and there are more of them.
    bool join_moves = true;
    std::optional<double> until_s;
    int harmonics =
        16;  // multiples of the tooth passing frequency; if teeth differ: of the spindle's, times flutes

    std::span<const dynamics::Mode> modes(std::size_t cutter) const {
        if (modes_of_cutter.empty()) return {};
        return modes_of_cutter[cutter];
    }
};

// The times of the moves: from prepare_mill(), or computed for a setup that prepare_mill() did not make.
// Never null. motion::schedule() must accept the moves.
std::shared_ptr<const motion::Schedule> schedule_of(const MillSetup& setup);

// For each move: true if it forms one pass with the move before it (milling::JoinedMoves).
std::vector<char> joins_of(const MillSetup& setup);

struct MillSinks {
    // Called in the order of time, only while cutting. May be empty. References are valid during the call.
    std::function<void(const milling::CutRow&, const milling::RowForce&)> row;
    std::function<bool(double fraction)>
        progress;  // called from time to time; false stops the run; may be empty
};

class MillSession {
  public:
    // The setup must pass the checks of prepare_mill(). The constructor carves the earlier cuts. `progress`
    // works as in MillSinks; if it returns false here, the session mills nothing.
    MillSession(MillSetup setup, ParallelFor parallel,
                const std::function<bool(double fraction)>& progress = {});
    ~MillSession();

    // Mills to the end. False: stopped by `progress`, with a partly milled stock.
    bool run(const MillSinks& sinks);
    // Mills the moves that begin before `t_s`, and the moves that share rows with the last of them. Can be
    // called again to continue.
    bool run_to(double t_s, const MillSinks& sinks);
    // The program time up to which the stock is milled.
    double milled_s() const;
    // The program time up to which rows and collisions are known: milled_s(), or later after set_back().
    double known_s() const;
    // Keeps states of the stock from now on, in about `most_bytes`, so that the stock can be set back. Call
    // it before anything is milled.
    void keep_states(std::size_t most_bytes = KeptStates::kMostBytes,
                     std::uint64_t spacing = KeptStates::kSpacing);
    // Puts the stock back to the last kept state with no move that begins at `t_s` or later. run_to() then
    // carves what was milled again, with no row and no collision, from the last kept state before its goal,
    // and mills on from there. The totals of volume are those of the stock.
    void set_back(double t_s);
    // The states; null without keep_states().
    const KeptStates* kept_states() const;

    // Duration of the program, or until_s if that is earlier.
    double duration_s() const;
    // The times of setup().moves.
    const motion::Schedule& schedule() const;
    const field::CarvedField& stock() const;
    // The move of setup().moves that made the surface of the stock at this point. None: the blank, or an
    // earlier job.
    std::optional<std::size_t> move_at(Vec3 surface_mm) const;
    // A reader of the stock for another thread while this one mills. At most one exists at a time. Created
    // and destroyed on the milling thread, before the session (field/carved/field_reader.hpp).
    std::unique_ptr<field::FieldReader> read_stock();
    const MillTotals& totals() const;
    const MillSetup& setup() const;
    // Gives the setup back, for a session that mills it again. After that this one can only be destroyed.
    MillSetup release_setup();

  private:
    class Run;
    std::unique_ptr<Run> run_;
};

}  // namespace tribo::session
