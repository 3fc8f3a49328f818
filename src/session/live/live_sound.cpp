// SPDX-License-Identifier: MIT
#include "session/live/live_sound.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace tribo::session {
namespace {

constexpr int kMostEdges = 1000;

// Samples between two updates from the pieces: four quanta, 5 ms.
constexpr std::int64_t kHop = std::int64_t{4} * sound::kQuantumFrames;
static_assert(kHop <= LiveVibration::kMostSamples);
// Clock correction, in s of sound: from this difference on the clock was set. Below it we assume network
// jitter and apply only a fraction.
constexpr double kSoundJumpS = 0.12, kJitterGain = 0.04;
// Largest correction of the phase per update: 3 Hz.
constexpr double kLargestCorrectionRad = 0.1;
// A vibrating cut goes on for so long, in s of sound, where its next piece is not here yet: it is cut at the
// clock, which a sound that takes time to be played runs ahead of.
constexpr double kLateS = 0.1;
// Pieces with a smaller gap are one cut.
constexpr double kSameCutS = 1e-4;

double end_s(const protocol::LiveSoundPiece& piece) {
    return piece.t_s + double{piece.duration_s};
}

Vec3 tip_mm(const protocol::LiveSoundPiece& piece) {
    return {piece.tip_mm[0], piece.tip_mm[1], piece.tip_mm[2]};
}

}  // namespace

LiveSound::LiveSound(sound::SoundtrackOptions base) : base_(std::move(base)), pieces_(kPieces) {
    spectrum_.harmonics.reserve(kHarmonics);
    begin();
}

void LiveSound::begin() {
    track_ = std::make_unique<sound::Soundtrack>(base_);
    left_ = 0;
    sounding_ = false;
    begin_job();
}

void LiveSound::begin_job() {
    written_ = 0;
    known_ = false;
    vibration_.reset();
    teeth_.clear();
}

void LiveSound::take(const job::Listening& listening) {
    if (!sound::is_valid(listening.workshop)) return;
    sound::SoundtrackOptions options = base_;
    job::apply(listening, options);
    if (!sound::check(options)) return;
    base_ = std::move(options);
    begin();
}

void LiveSound::take(const protocol::LiveBending& bending) {
    vibration_ = LiveVibration::make(bending, base_.sample_rate_hz);
    teeth_.resize(vibration_ ? kPieces : 0);
    for (std::size_t slot = 0; vibration_ && slot < std::min(written_, kPieces); ++slot) read_teeth(slot);
}

void LiveSound::read_teeth(std::size_t slot) {
    teeth_[slot].vibrates = vibration_->read(pieces_[slot], teeth_[slot].cut);
}

void LiveSound::take(const protocol::LiveSoundPieces& sound) {
    for (const protocol::LiveSoundPiece& told : sound.pieces) {
        protocol::LiveSoundPiece& piece = pieces_[written_ % kPieces];
        // Keeps the allocated memory of its harmonics.
        piece = told;
        piece.order_step = std::max(piece.order_step, 1);
        piece.edges = std::clamp(piece.edges, 0, kMostEdges);
        if (written_ == 0) {
            idle_tip_mm_ = tip_mm(piece);
            idle_rad_per_s_ = double{piece.spindle_rad_per_s};
        }
        if (vibration_) read_teeth(written_ % kPieces);
        ++written_;
    }
}

void LiveSound::follow(double t_s, double speed, bool playing, double lead_s) {
    if (!std::isfinite(t_s) || !(speed > 0)) return;
    const double told = t_s + (playing ? speed * pace_ * std::clamp(lead_s, 0.0, 1.0) : 0);
    const double off = told - clock_s_;
    const bool set =
        !known_ || speed != speed_ || playing != playing_ || std::abs(off) > kSoundJumpS * speed * pace_;
    clock_s_ = set ? told : clock_s_ + kJitterGain * off;
    speed_ = speed;
    playing_ = playing;
    known_ = true;
}

std::size_t LiveSound::piece_at(double t_s) const {
    const std::size_t oldest = written_ > kPieces ? written_ - kPieces : 0;
    // The clock is near the end of the milled part.
    for (std::size_t n = written_; n > oldest; --n) {
        const protocol::LiveSoundPiece& piece = pieces_[(n - 1) % kPieces];
        if (t_s < piece.t_s - kSameCutS) continue;
        return t_s <= end_s(piece) + kSameCutS ? n : 0;
    }
    return 0;
}

std::size_t LiveSound::late_piece(double t_s) const {
    if (!vibration_ || !sounding_ || written_ == 0) return 0;
    const std::size_t slot = (written_ - 1) % kPieces;
    const double late_s = t_s - end_s(pieces_[slot]);
    return teeth_[slot].vibrates && late_s > 0 && late_s < kLateS * speed_ * pace_ ? written_ : 0;
}

// The spindle continues with its last speed.
void LiveSound::idle() {
    contact::ContactSample s;
    s.t_s = static_cast<double>(track_->frames_rendered() + kHop) / base_.sample_rate_hz;
    s.position_mm = idle_tip_mm_;
    s.phase_rate_rad_per_s = idle_rad_per_s_;
    track_->excite(s);
}

void LiveSound::steer() {
    const double hop_s = static_cast<double>(kHop) / base_.sample_rate_hz;
    const double t_s = clock_s_ + speed_ * pace_ * hop_s;
    std::size_t number = known_ && playing_ ? piece_at(t_s) : 0;
    if (number == 0 && known_ && playing_) number = late_piece(t_s);
    if (number == 0) {
        if (vibration_) vibration_->rest(static_cast<std::size_t>(kHop));
        if (known_ && playing_ && written_ > 0) {
            idle();
        } else {
            track_->release();
        }
        sounding_ = false;
        return;
    }
    const std::size_t slot = (number - 1) % kPieces;
    const protocol::LiveSoundPiece* piece = &pieces_[slot];
    const Teeth* teeth = vibration_ && teeth_[slot].vibrates ? &teeth_[slot] : nullptr;
    contact::ForceTrace trace{static_cast<double>(base_.sample_rate_hz), track_->frames_rendered(), {}};
    if (teeth != nullptr) {
        trace.force_n = vibration_->run(teeth->cut, number, static_cast<std::size_t>(kHop));
    } else if (vibration_) {
        vibration_->rest(static_cast<std::size_t>(kHop));
    }
    pace_ = piece->pace > 0 ? double{piece->pace} : 1;
    const double rad_per_s = double{piece->spindle_rad_per_s};
    const double there = double{piece->spindle_angle_rad} + rad_per_s / pace_ * (t_s - piece->t_s);
    if (!sounding_) {
        phase_rad_ = teeth != nullptr ? vibration_->phase_rad(teeth->cut) : there;
    } else {
        phase_rad_ += rad_per_s * hop_s;
        if (speed_ == 1 && teeth == nullptr) {
            const double off = std::remainder(there - phase_rad_, math::kTwoPi);
            phase_rad_ += std::clamp(off, -kLargestCorrectionRad, kLargestCorrectionRad);
        }
    }
    phase_rad_ = std::fmod(phase_rad_, math::kTwoPi);
    sounding_ = true;

    spectrum_.order_step = piece->order_step;
    spectrum_.harmonics.resize(std::min(piece->harmonics.size(), kHarmonics));
    for (std::size_t n = 0; n < spectrum_.harmonics.size(); ++n) {
        const protocol::LiveHarmonic& told = piece->harmonics[n];
        spectrum_.harmonics[n].x = std::complex<double>(told[0]);
        spectrum_.harmonics[n].y = std::complex<double>(told[1]);
    }
    if (!spectrum_.harmonics.empty())
        spectrum_.harmonics[0].torque = static_cast<double>(piece->mean_torque_nmm);
    idle_tip_mm_ = tip_mm(*piece);
    idle_rad_per_s_ = rad_per_s;
    contact::ContactSample s;
    s.t_s = static_cast<double>(track_->frames_rendered() + kHop) / base_.sample_rate_hz;
    s.position_mm = idle_tip_mm_;
    s.removed_mm3_per_s = double{piece->chip_mm3_per_s};
    s.phase_rad = phase_rad_;
    s.phase_rate_rad_per_s = rad_per_s;
    s.spectrum = &spectrum_;
    s.edges = piece->edges;
    if (teeth != nullptr) s.vibration = &trace;
    track_->excite(s);
}

void LiveSound::render(std::span<float> interleaved) {
    while (!interleaved.empty()) {
        if (left_ == 0) {
            steer();
            left_ = kHop;
        }
        const auto frames = std::min<std::int64_t>(left_, static_cast<std::int64_t>(interleaved.size() / 2));
        if (frames == 0) return;
        track_->render(interleaved.first(static_cast<std::size_t>(2 * frames)));
        interleaved = interleaved.subspan(static_cast<std::size_t>(2 * frames));
        left_ -= frames;
        if (playing_) clock_s_ += speed_ * pace_ * static_cast<double>(frames) / base_.sample_rate_hz;
    }
}

}  // namespace tribo::session
