// SPDX-License-Identifier: MIT
// The rows of a live mill, with their forces as a viewer sees and hears them. A change of feed, spindle,
// material or helix changes the forces of all rows. The rows at the clock get them at once, those before it
// in slices, so that no picture waits for them. Bands from cases are computed with the forces. No threads and
// no clocks of its own.
#pragma once

#include <optional>
#include <vector>

#include "base/parallel.hpp"
#include "protocol/live_frame.hpp"
#include "session/cut/cut_record.hpp"
#include "session/cut/mill_session.hpp"
#include "session/uncertain/force_bands.hpp"

namespace tribo::session {

class LiveCut {
  public:
    explicit LiveCut(ParallelFor parallel) : parallel_(std::move(parallel)) {}

    // Begins without rows. The change stays. `setup` must outlive the rows. `bends`: pieces of sound have
    // their teeth.
    void begin(const MillSetup& setup, bool bends);
    // Adds a row with its force at the programmed feed and speed.
    void add(const milling::CutRow& row, const milling::RowForce& force);
    // Changes the forces of all rows. Rows that end before `clock_s` are not heard again. Cheap: the next two
    // functions do the work. Of several changes at one time, the last one wins.
    void set_change(const CutChange& change, double clock_s);
    const CutChange& change() const { return change_; }
    // The clock was set, so that rows from that time on are heard again, by hear_to(). Sound that was not
    // taken is dropped.
    void hear_from(double t_s);
    // Makes the sound of the known rows up to that time.
    void hear_to(double t_s);
    // The viewer's time passes: all rows are sent anew at most every kRestS.
    void pass(double dt_s) { rest_s_ -= dt_s; }
    // Computes the changed forces of the rows that are new or at the clock.
    void compute_new();
    // Computes a slice of the changed forces of the rows before: once per picture.
    void compute_slice();

    const CutRecord& record() const { return record_; }
    // The row of this time, or the last one before it; 0 if there is none.
    std::size_t row_at(double t_s) const;
    // The row that is cut at this time.
    std::optional<std::size_t> row_cut_at(double t_s) const;
    // Rows that were sent, and how many times all of them were sent anew.
    std::size_t rows_sent() const { return sent_; }
    int times_anew() const { return times_anew_; }
    // Sets what the cut is at the time of the state.
    void describe(protocol::LiveState& state) const;
    // Sends rows that are new or changed, some of them at each call.
    void show_rows(const protocol::FrameSink& frames);
    // Returns the pieces of sound since the last call.
    protocol::LiveSoundPieces take_sound();

  private:
    static constexpr double kRestS = 0.25;

    void compute(std::size_t first, std::size_t last, const CutChange& change, std::size_t first_heard);
    void use_cases();
    void set_band(std::size_t row, const milling::ForcePeaks& peaks, const CutChange& change);
    void set_force(std::size_t row, const milling::RowForce& force, const CutChange& change);

    ParallelFor parallel_;
    const MillSetup* setup_ = nullptr;
    bool bends_ = false;
    CutChange change_;
    std::optional<ForceCases> cases_;  // with this change
    CutRecord record_;
    std::vector<protocol::LiveRow> rows_;  // one per row of the record
    struct RowState {
        Vec3 force_n;            // stock frame
        double removed_mm3 = 0;  // up to the end of this row
    };
    std::vector<RowState> states_;     // one per row
    protocol::LiveSoundPieces sound_;  // not taken yet
    std::size_t sent_ = 0;             // rows
    bool anew_ = false;                // the next rows replace all that were sent
    int times_anew_ = 0;
    // Rows from here on have no force yet, or one of an older change.
    std::size_t fresh_ = 0;
    std::size_t heard_ = 0;                     // rows before this one get no sound as they are added
    std::size_t hear_next_ = 0, hear_end_ = 0;  // known rows that are heard again
    std::size_t known_ = 0;                     // rows at the newest change
    // The rows before the clock: a pass computes them for one change. A later change waits for its end.
    std::size_t clock_row_ = 0;  // at the time of the newest change
    bool outdated_ = false, passing_ = false;
    std::size_t pass_next_ = 0, pass_end_ = 0;
    CutChange pass_change_;
    double rest_s_ = 0;  // until the next pass may begin
};

}  // namespace tribo::session
