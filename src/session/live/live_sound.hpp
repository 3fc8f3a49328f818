// SPDX-License-Identifier: MIT
// Sound of a live mill, rendered from pieces of the cut: in the audio thread of the page (from frames) and in
// the program. A program clock runs beside the sample clock and is corrected by follow(). So the sound is at
// the same program time as the picture, and its phase is the phase of the spindle.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "protocol/live_frame.hpp"
#include "session/live/live_vibration.hpp"
#include "sound/play/soundtrack.hpp"

namespace tribo::session {

// Sound update inside one process; same contents as the frames of these kinds.
using LiveSoundUpdate = std::variant<job::Listening, protocol::LiveBending, protocol::LiveSoundPieces>;

// One thread. take() allocates, also later where a tool bends; render() never. 1 MB; for each cutter of a
// tool that bends a few more, at slow spindles tens.
//
// At speed 1 the phase is the spindle angle at the program time. At other speeds the cut at the current
// program time sounds at its true pitch. A tool that bends vibrates in the time of the sound: then the phase
// runs freely, and the spindle keeps its speed exactly.
class LiveSound {
  public:
    // `base`: sample rate, head and seed. take(Listening) sets the rest.
    explicit LiveSound(sound::SoundtrackOptions base);

    // Discards all data of the job before.
    void begin_job();
    // Sets listener and workshop, and begins a job. Invalid values are ignored.
    void take(const job::Listening& listening);
    // From here on the tool bends, until the next job. Values out of range: it does not.
    void take(const protocol::LiveBending& bending);
    // A later piece replaces an earlier piece with the same time.
    void take(const protocol::LiveSoundPieces& sound);
    // Corrects the program clock: the next rendered sample is at t_s. `lead_s` of rendered sound is not
    // played yet.
    void follow(double t_s, double speed, bool playing, double lead_s = 0);
    // interleaved.size() / 2 frames.
    void render(std::span<float> interleaved);

    // Program time of the next sample.
    double program_s() const { return clock_s_; }
    int sample_rate_hz() const { return base_.sample_rate_hz; }

  private:
    static constexpr std::size_t kPieces = 1024, kHarmonics = 65;
    void begin();
    // Its number from 1; 0: none.
    std::size_t piece_at(double t_s) const;
    // The last piece, if it goes on.
    std::size_t late_piece(double t_s) const;
    void read_teeth(std::size_t slot);
    void steer();
    void idle();

    sound::SoundtrackOptions base_;
    std::unique_ptr<sound::Soundtrack> track_;
    std::vector<protocol::LiveSoundPiece> pieces_;  // the last kPieces
    std::size_t written_ = 0;                       // number of pieces so far
    double clock_s_ = 0, speed_ = 1, pace_ = 1;
    bool playing_ = false, known_ = false, sounding_ = false;
    double phase_rad_ = 0;
    Vec3 idle_tip_mm_;  // position of the tool in air
    double idle_rad_per_s_ = 0;
    std::int64_t left_ = 0;  // samples until the next update from the pieces
    contact::ForceSpectrum spectrum_;
    std::unique_ptr<LiveVibration> vibration_;  // null: no tool bends
    struct Teeth {
        LiveVibration::Cut cut;
        bool vibrates = false;
    };
    std::vector<Teeth> teeth_;  // of the pieces; empty: no tool bends
};

}  // namespace tribo::session
