// SPDX-License-Identifier: MIT
// A milling job as a film that is made while it is watched: a clock that plays, pauses, runs faster and is
// set, the part milled up to it, and frames of what has changed. No threads and no clocks of its own: the
// caller says how much time has passed and when to stop for now.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "base/result.hpp"
#include "protocol/live_frame.hpp"
#include "session/cut/cut_record.hpp"
#include "session/cut/mill_session.hpp"
#include "session/live/live_sound.hpp"
#include "session/live/part_picture.hpp"

namespace tribo::session {

// What a viewer is told besides the mill itself.
struct LiveExtras {
    std::optional<job::Listening> listening{};  // none: from the centre of the blank's top
    std::shared_ptr<const TriangleMesh> designed{};
};

class LiveMill {
  public:
    // Makes the same setup each time: the clock was set back, and the part begins again. Its moves should be
    // short (MillOptions::longest_piece_mm), as the part is seen between moves only.
    using MakeSetup = std::function<Result<MillSetup>()>;
    static constexpr double kPieceMm = 2;
    static constexpr double kFastest = 1000;  // seconds of the program per second

    static Result<std::unique_ptr<LiveMill>> create(MakeSetup make_setup, ParallelFor parallel,
                                                    LiveExtras extras = {});

    double duration_s() const { return session_->duration_s(); }
    double clock_s() const { return clock_s_; }
    bool playing() const { return playing_; }
    protocol::LiveState state() const;
    const MillSession& session() const { return *session_; }
    // What was cut so far.
    const CutRecord& record() const { return record_; }

    // At the end, play begins anew.
    void play(bool on);
    void set_speed(double seconds_per_second);  // > 0, at most kFastest; else nothing changes
    void set_clock(double t_s);                 // clamped to the program; not a number: nothing changes
    // Overrides of feed and spindle, another material or helix: rows so far are told anew, the clock of the
    // program as it was written runs faster by the feed's.
    void set_change(const CutChange& change);
    const CutChange& change() const { return change_; }
    double speed() const { return speed_; }
    double pace() const { return playing_ ? speed_ * change_.feed_factor : 0; }
    // Told the session that mills from now on, and null before it goes.
    void watch(std::function<void(MillSession*)> watcher);
    // An ear in this process, told with the frames from now on.
    void hear(std::function<void(LiveSoundNews)> ear) { ear_ = std::move(ear); }

    // The viewer's time moves on by dt_s >= 0: mills towards the clock as long as `has_time` says so (asked
    // every few moves), then tells what is new (LiveMemory keeps it for who comes later). The clock waits for
    // the part.
    Result<void> tick(double dt_s, const std::function<bool()>& has_time, const protocol::FrameSink& frames);

  private:
    LiveMill(MakeSetup make_setup, ParallelFor parallel, LiveExtras extras)
        : make_setup_(std::move(make_setup)), parallel_(std::move(parallel)), extras_(std::move(extras)) {}
    Result<void> begin();
    void add_row(const milling::CutRow& row);
    void set_force(std::size_t row, const milling::RowForce& force);
    void set_changed_forces(std::size_t first_row, std::size_t first_heard);
    void show_job(const protocol::FrameSink& frames);
    void show_part(const Box3& box_mm, const protocol::FrameSink& frames);
    void show_rows(const protocol::FrameSink& frames);
    void show_sound(const protocol::FrameSink& frames);
    void show_designed(const protocol::FrameSink& frames);
    job::Listening listening() const;
    void show_state(const protocol::FrameSink& frames);

    MakeSetup make_setup_;
    ParallelFor parallel_;
    LiveExtras extras_;
    std::unique_ptr<MillSession> session_;
    std::unique_ptr<PartPicture> picture_;
    protocol::LivePath path_;
    std::vector<protocol::LiveRow> rows_;
    // What a state needs of a row besides.
    struct RowState {
        Vec3 force_n;            // stock frame
        double removed_mm3 = 0;  // up to and with this row
    };
    std::vector<RowState> row_states_;  // one per row
    CutRecord record_;                  // likewise
    protocol::LiveSoundPieces sound_;   // not yet told
    CutChange change_;
    bool rows_anew_ = false;
    std::function<void(MillSession*)> watcher_;
    std::function<void(LiveSoundNews)> ear_;
    std::size_t rows_sent_ = 0, collisions_sent_ = 0;
    double clock_s_ = 0, speed_ = 1, shown_s_ = 0;
    bool playing_ = false, set_back_ = false, begun_anew_ = false;
    std::vector<std::uint8_t> frame_, last_state_;
};

}  // namespace tribo::session
