// SPDX-License-Identifier: MIT
// What a live mill sounds like, made from its frames alone: the page's audio thread and whoever else listens
// to a stream or a recording of frames. A clock of the program, steered by the states that arrive, runs
// beside the clock of the samples: the sound stands where the picture stands, and its phase is the spindle's.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "protocol/live_frame.hpp"
#include "sound/play/soundtrack.hpp"

namespace tribo::session {

// One thread; take() may allocate when a job begins, render() never does. 1 MB.
//
// At speed 1 the phase is that of the spindle angle at the program's time. At other speeds the cut is heard
// as it sounds where the clock stands, at its true pitch: a tooth is no slower for being watched slowly.
class LiveSound {
  public:
    // `base`: sample rate, head and seed; the rest comes from the frames.
    explicit LiveSound(sound::SoundtrackOptions base);

    // Frames of kinds job, listening, sound and state count; others and what is no frame are left alone.
    void take(std::span<const std::uint8_t> frame);
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
    struct Piece {
        double t_s = 0, end_s = 0;
        Vec3 tip_mm;
        double angle_rad = 0, rad_per_s = 0, pace = 1, chip_mm3_per_s = 0, torque_nmm = 0;
        int edges = 0, order_step = 1;
        std::size_t harmonics = 0;
        std::array<std::array<float, 4>, kHarmonics> xy{};  // re x, im x, re y, im y
    };
    void begin();
    void take_pieces(std::span<const std::uint8_t> frame);
    const Piece* piece_at(double t_s) const;
    void steer();
    void idle();

    sound::SoundtrackOptions base_;
    std::unique_ptr<sound::Soundtrack> track_;
    std::unique_ptr<std::array<Piece, kPieces>> pieces_;
    std::size_t written_ = 0;  // pieces so far
    double clock_s_ = 0, speed_ = 1, pace_ = 1;
    bool playing_ = false, known_ = false, sounding_ = false;
    double phase_rad_ = 0;
    Vec3 idle_tip_mm_;  // where no metal is cut
    double idle_rad_per_s_ = 0;
    std::int64_t left_ = 0;  // samples until the next look at the pieces
    contact::ForceSpectrum spectrum_;
};

}  // namespace tribo::session
