// SPDX-License-Identifier: MIT
// What a live mill sounds like, made from the pieces of the cut that it tells: in the page's audio thread
// (out of frames) and in the program. A clock of the program, steered by the states that arrive, runs beside
// the clock of the samples: the sound stands where the picture stands, and its phase is the spindle's.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "protocol/live_frame.hpp"
#include "sound/play/soundtrack.hpp"

namespace tribo::session {

// What a live mill tells an ear in this process: the same as its frames of these kinds.
using LiveSoundNews = std::variant<job::Listening, protocol::LiveSoundPieces>;

// One thread; take() allocates until a thousand pieces were told, render() never does. 1 MB.
//
// At speed 1 the phase is that of the spindle angle at the program's time. At other speeds the cut is heard
// as it sounds where the clock stands, at its true pitch: a tooth is no slower for being watched slowly.
class LiveSound {
  public:
    // `base`: sample rate, head and seed; the rest comes with the listening.
    explicit LiveSound(sound::SoundtrackOptions base);

    // What was told of the job before is void.
    void begin_job();
    // Who listens from now on; begins a job too. What no soundtrack can have is left alone.
    void take(const job::Listening& listening);
    // A later piece of the same time replaces the earlier.
    void take(const protocol::LiveSoundPieces& sound);
    // The clock of the program is at t_s now, at the next sample that will be rendered, and `lead_s` of sound
    // more is on its way to the ear.
    void follow(double t_s, double speed, bool playing, double lead_s = 0);
    // interleaved.size() / 2 frames.
    void render(std::span<float> interleaved);

    // Where in the program the next sample is.
    double program_s() const { return clock_s_; }
    int sample_rate_hz() const { return base_.sample_rate_hz; }

  private:
    static constexpr std::size_t kPieces = 1024, kHarmonics = 65;
    void begin();
    const protocol::LiveSoundPiece* piece_at(double t_s) const;
    void steer();
    void idle();

    sound::SoundtrackOptions base_;
    std::unique_ptr<sound::Soundtrack> track_;
    std::vector<protocol::LiveSoundPiece> pieces_;  // the last kPieces
    std::size_t written_ = 0;                       // pieces so far
    double clock_s_ = 0, speed_ = 1, pace_ = 1;
    bool playing_ = false, known_ = false, sounding_ = false;
    double phase_rad_ = 0;
    Vec3 idle_tip_mm_;  // where no metal is cut
    double idle_rad_per_s_ = 0;
    std::int64_t left_ = 0;  // samples until the next look at the pieces
    contact::ForceSpectrum spectrum_;
};

}  // namespace tribo::session
