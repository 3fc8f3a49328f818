// SPDX-License-Identifier: MIT
// A milling job that is shown while it is milled. It has a program clock (play, pause, speed, seek), a part
// milled up to this clock, and frames for all changes. No threads and no real clock: the caller gives the
// passed time and a time budget.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/limits.hpp"
#include "base/result.hpp"
#include "protocol/live_frame.hpp"
#include "session/audit/cut_limits.hpp"
#include "session/cut/mill_session.hpp"
#include "session/live/live_chatter.hpp"
#include "session/live/live_cut.hpp"
#include "session/live/live_sound.hpp"
#include "session/live/part_picture.hpp"

namespace tribo::session {

// What a job tells a viewer beside its cut.
struct LiveExtras {
    std::optional<job::Listening> listening{};  // none: at the centre of the top of the blank
    std::shared_ptr<const TriangleMesh> designed{};
    std::string material{};           // its name; empty: coefficients of the job's own
    protocol::LiveProgram program{};  // without a name: none is told
    Warnings warnings{};
    std::optional<CutLimits> limits{};  // for an audit of the cut (live_audit.hpp)
};

// What the files of a job make.
struct LiveInput {
    LiveInput(MillSetup cut, LiveExtras told = {}) : setup(std::move(cut)), extras(std::move(told)) {}
    MillSetup setup;
    LiveExtras extras;
};

class LiveMill {
  public:
    // Reads the files. Called again, with each tick until it gives a value, when the clock is set back and
    // the files have changed; the part stands still meanwhile. If it then fails, the input before is milled
    // again (input_error()). The first call must give a value. Moves should be short
    // (MillOptions::longest_piece_mm): the part is shown only between moves.
    using MakeInput = std::function<std::optional<Result<LiveInput>>()>;
    static constexpr double kPieceMm = 2;
    static constexpr double kFastest = kLimits.play_speed.range.max;  // program seconds per second

    // `files_changed`: whether MakeInput would read other files than the last time; empty: always. As long as
    // they are the same, a clock that is set back keeps the rows and all that is known of them, and only the
    // part is carved again.
    static Result<std::unique_ptr<LiveMill>> create(MakeInput make_input, ParallelFor parallel,
                                                    std::function<bool()> files_changed = {});

    double duration_s() const { return session_->duration_s(); }
    double clock_s() const { return clock_s_; }
    bool playing() const { return playing_; }
    protocol::LiveState state() const;
    const MillSession& session() const { return *session_; }
    const LiveExtras& extras() const { return extras_; }
    // Number of sessions so far: a new one begins when the files have changed.
    int sessions() const { return sessions_; }
    // The rows so far.
    const CutRecord& record() const { return cut_.record(); }
    // That of LiveChatter.
    std::optional<double> multiplier(std::size_t row) const {
        return chatter_ ? chatter_->multiplier(row) : std::nullopt;
    }
    // The error of the last call of MakeInput; none: it read the files.
    const std::optional<Error>& input_error() const { return input_error_; }

    // play(true) at the end starts again from the beginning.
    void play(bool on);
    void set_speed(double seconds_per_second);  // > 0, at most kFastest; other values are ignored
    void set_clock(double t_s);                 // clamped to the program; NaN is ignored
    // Sets overrides of feed and spindle, material or helix, with the next tick. All rows are sent again once
    // their forces are computed. The program clock runs faster by the feed override.
    void set_change(const CutChange& change);
    const CutChange& change() const { return cut_.change(); }
    double speed() const { return speed_; }
    double pace() const { return playing_ ? speed_ * change().feed_factor : 0; }
    // Called with each new session, and with null before a session is destroyed.
    void set_session_observer(std::function<void(MillSession*)> observer);
    // Receiver of sound updates in this process, called together with the frames.
    void set_sound_listener(std::function<void(LiveSoundUpdate)> ear) { sound_listener_ = std::move(ear); }

    // Advances the time by dt_s >= 0. Mills towards the clock and draws what has changed, while `has_time` is
    // true (checked every few moves or chunks), and sends frames for all changes (FrameCache keeps them). The
    // clock waits for the part. While it plays, the part also waits for its picture.
    void tick(double dt_s, const std::function<bool()>& has_time, const protocol::FrameSink& frames);

  private:
    LiveMill(MakeInput make_input, ParallelFor parallel, std::function<bool()> files_changed);
    Result<void> begin(Result<LiveInput> input);
    void begin_again();
    void go_back();
    // The part is milled to the clock and its picture shows it.
    bool is_shown() const;
    // The part is carved again and has not reached the clock.
    bool catches_up() const;
    void take(LiveExtras extras);
    void mill(double target_s, const std::function<bool()>& has_time);
    void show_job(const protocol::FrameSink& frames);
    void show_part(const std::function<bool()>& has_time, const protocol::FrameSink& frames);
    void show_collisions(const protocol::FrameSink& frames);
    void show_bending(const protocol::FrameSink& frames);
    void show_sound(const protocol::FrameSink& frames);
    void show_designed(const protocol::FrameSink& frames);
    job::Listening listening() const;
    void show_state(const protocol::FrameSink& frames);

    MakeInput make_input_;
    std::function<bool()> files_changed_;
    ParallelFor parallel_;
    LiveExtras extras_;
    // Null: there is no designed surface, or it has no area.
    std::shared_ptr<const surface::DesignedSurface> compared_;
    std::unique_ptr<MillSession> session_;
    std::unique_ptr<PartPicture> picture_;
    protocol::LivePath path_;
    LiveCut cut_;
    std::optional<LiveChatter> chatter_;  // none: nothing bends
    std::optional<Error> input_error_;
    std::function<void(MillSession*)> session_observer_;
    std::function<void(LiveSoundUpdate)> sound_listener_;
    int sessions_ = 0;
    std::size_t collisions_sent_ = 0;
    double clock_s_ = 0, speed_ = 1;
    double marked_s_ = 0;  // the picture knows of the cut up to this time
    bool reads_ = false;   // the files, before a new session
    bool playing_ = false, set_back_ = false, jumped_ = false, begun_anew_ = false, designed_waits_ = false;
    std::vector<std::uint8_t> frame_, last_state_, last_bending_;
};

}  // namespace tribo::session
