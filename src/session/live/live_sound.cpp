// SPDX-License-Identifier: MIT
#include "session/live/live_sound.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/math.hpp"

namespace tribo::session {
namespace {

constexpr std::uint32_t kMostEdges = 1000;

// Samples between two looks at the pieces: four quanta, 5 ms.
constexpr std::int64_t kHop = std::int64_t{4} * sound::kQuantumFrames;
// A clock that is told this far from where it was thought, in s of sound, was set; less is jitter of who
// tells, of which a share is believed.
constexpr double kJumpS = 0.12, kBelieved = 0.04;
// The phase follows the spindle's by at most this much a hop: 3 Hz.
constexpr double kLargestCorrectionRad = 0.1;
// Pieces this near to one another are one cut.
constexpr double kSameCutS = 1e-4;

// Little-endian values of a frame, zeros beyond its end.
class Reader {
  public:
    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    bool has(std::size_t bytes) const { return at_ + bytes <= bytes_.size(); }
    std::uint32_t u32() { return static_cast<std::uint32_t>(bits(4)); }
    double f32() { return static_cast<double>(std::bit_cast<float>(u32())); }
    double f64() { return std::bit_cast<double>(bits(8)); }
    Vec3 vec3() {
        const double x = f32(), y = f32(), z = f32();
        return {x, y, z};
    }
    void skip(std::size_t bytes) { at_ += bytes; }

  private:
    std::uint64_t bits(std::size_t bytes) {
        std::uint64_t v = 0;
        if (has(bytes)) {
            for (std::size_t n = 0; n < bytes; ++n) v |= std::uint64_t{bytes_[at_ + n]} << (8 * n);
        }
        at_ += bytes;
        return v;
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 16;
};

}  // namespace

LiveSound::LiveSound(sound::SoundtrackOptions base)
    : base_(std::move(base)), pieces_(std::make_unique<std::array<Piece, kPieces>>()) {
    spectrum_.harmonics.reserve(kHarmonics);
    begin();
}

void LiveSound::begin() {
    track_ = std::make_unique<sound::Soundtrack>(base_);
    written_ = 0;
    left_ = 0;
    known_ = sounding_ = false;
}

void LiveSound::take(std::span<const std::uint8_t> frame) {
    if (frame.size() < 16 || frame[1] != protocol::kLiveFrameVersion) return;
    Reader r(frame);
    switch (static_cast<protocol::LiveFrame>(frame[0])) {
        case protocol::LiveFrame::job:
            written_ = 0;
            known_ = false;
            break;
        case protocol::LiveFrame::listening: {
            job::Listening l;
            l.listener_mm = r.vec3();
            l.distance_factor = r.f32();
            l.gain_db = r.f32();
            for (std::size_t n = 0; n < 2; ++n) l.tool.modes[n] = {r.f32(), r.f32()};
            l.reference_distance_m = r.f32();
            l.workshop.machine = r.u32();
            l.workshop.room = r.u32();
            l.workshop.chips = static_cast<sound::ChipMaterial>(std::min(r.u32(), 255U));
            for (double* db :
                 {&l.workshop.cut_db, &l.workshop.spindle_db, &l.workshop.chips_db, &l.workshop.room_db})
                *db = r.f32();
            if (!sound::is_valid(l.workshop)) return;
            sound::SoundtrackOptions options = base_;
            job::apply(l, options);
            if (!sound::check(options)) return;
            base_ = std::move(options);
            begin();
            break;
        }
        case protocol::LiveFrame::sound:
            take_pieces(frame);
            break;
        default:
            break;
    }
}

void LiveSound::take_pieces(std::span<const std::uint8_t> frame) {
    Reader r(frame);
    const std::size_t first = written_;
    for (std::uint32_t count = r.u32(); count > 0 && r.has(48); --count) {
        Piece& piece = (*pieces_)[written_ % kPieces];
        piece.edges = 0;
        piece.torque_nmm = 0;
        piece.t_s = r.f64();
        piece.end_s = piece.t_s + r.f32();
        piece.tip_mm = r.vec3();
        piece.angle_rad = r.f32();
        piece.rad_per_s = r.f32();
        piece.pace = r.f32();
        piece.chip_mm3_per_s = r.f32();
        piece.order_step = std::max(static_cast<int>(r.u32()), 1);
        const std::uint32_t told = r.u32();
        if (!r.has(std::size_t{24} * told)) return;
        piece.harmonics = std::min<std::size_t>(told, kHarmonics);
        for (std::uint32_t n = 0; n < told; ++n) {
            std::array<float, 4> xy{};
            for (float& v : xy) v = static_cast<float>(r.f32());
            r.skip(8);
            if (n < piece.harmonics) piece.xy[n] = xy;
        }
        if (written_ == 0) {
            idle_tip_mm_ = piece.tip_mm;
            idle_rad_per_s_ = piece.rad_per_s;
        }
        ++written_;
    }
    // Frames of earlier versions of the program end here.
    for (std::size_t n = first; n < written_ && r.has(8); ++n) {
        Piece& piece = (*pieces_)[n % kPieces];
        piece.edges = static_cast<int>(std::min(r.u32(), kMostEdges));
        piece.torque_nmm = r.f32();
    }
}

void LiveSound::follow(double t_s, double speed, bool playing, double lead_s) {
    if (!std::isfinite(t_s) || !(speed > 0)) return;
    const double told = t_s + (playing ? speed * pace_ * std::clamp(lead_s, 0.0, 1.0) : 0);
    const double off = told - clock_s_;
    const bool set =
        !known_ || speed != speed_ || playing != playing_ || std::abs(off) > kJumpS * speed * pace_;
    clock_s_ = set ? told : clock_s_ + kBelieved * off;
    speed_ = speed;
    playing_ = playing;
    known_ = true;
}

const LiveSound::Piece* LiveSound::piece_at(double t_s) const {
    const std::size_t oldest = written_ > kPieces ? written_ - kPieces : 0;
    // The clock is near the end of what is milled.
    for (std::size_t n = written_; n > oldest; --n) {
        const Piece& piece = (*pieces_)[(n - 1) % kPieces];
        if (t_s < piece.t_s - kSameCutS) continue;
        return t_s <= piece.end_s + kSameCutS ? &piece : nullptr;
    }
    return nullptr;
}

// The spindle turns on as it did last.
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
    const Piece* piece = known_ && playing_ ? piece_at(t_s) : nullptr;
    if (piece == nullptr) {
        if (known_ && playing_ && written_ > 0) {
            idle();
        } else {
            track_->release();
        }
        sounding_ = false;
        return;
    }
    pace_ = piece->pace > 0 ? piece->pace : 1;
    const double there = piece->angle_rad + piece->rad_per_s / pace_ * (t_s - piece->t_s);
    if (!sounding_) {
        phase_rad_ = there;
    } else {
        phase_rad_ += piece->rad_per_s * hop_s;
        if (speed_ == 1) {
            const double off = std::remainder(there - phase_rad_, math::kTwoPi);
            phase_rad_ += std::clamp(off, -kLargestCorrectionRad, kLargestCorrectionRad);
        }
    }
    phase_rad_ = std::fmod(phase_rad_, math::kTwoPi);
    sounding_ = true;

    spectrum_.order_step = piece->order_step;
    spectrum_.harmonics.resize(piece->harmonics);
    for (std::size_t n = 0; n < piece->harmonics; ++n) {
        const auto& xy = piece->xy[n];
        spectrum_.harmonics[n].x = {static_cast<double>(xy[0]), static_cast<double>(xy[1])};
        spectrum_.harmonics[n].y = {static_cast<double>(xy[2]), static_cast<double>(xy[3])};
    }
    if (!spectrum_.harmonics.empty()) spectrum_.harmonics[0].torque = piece->torque_nmm;
    idle_tip_mm_ = piece->tip_mm;
    idle_rad_per_s_ = piece->rad_per_s;
    contact::ContactSample s;
    s.t_s = static_cast<double>(track_->frames_rendered() + kHop) / base_.sample_rate_hz;
    s.position_mm = piece->tip_mm;
    s.removed_mm3_per_s = piece->chip_mm3_per_s;
    s.phase_rad = phase_rad_;
    s.phase_rate_rad_per_s = piece->rad_per_s;
    s.spectrum = &spectrum_;
    s.edges = piece->edges;
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
