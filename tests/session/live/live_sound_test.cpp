// SPDX-License-Identifier: MIT
// The sound of pieces of a cut against the soundtrack of the same cut, told directly.
#include "session/live/live_sound.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "sound/play/calibration.hpp"

namespace tribo::session {
namespace {

constexpr double kRpm = 6000, kToothHz = 200, kToneN = 60;
constexpr double kRadPerS = kRpm / 60 * math::kTwoPi;
constexpr int kRate = 48000;

sound::SoundtrackOptions options() {
    sound::SoundtrackOptions o;
    o.sample_rate_hz = kRate;
    return o;
}

// A steady cut in pieces of 30 ms; the phase of its one tone at angle 0 is zero.
std::vector<protocol::LiveSoundPiece> cut(double from_s, double to_s) {
    std::vector<protocol::LiveSoundPiece> pieces;
    for (double t = from_s; t < to_s - 1e-9; t += 0.03) {
        protocol::LiveSoundPiece p;
        p.t_s = t;
        p.duration_s = 0.03f;
        p.spindle_angle_rad = static_cast<float>(std::fmod(kRadPerS * t, math::kTwoPi));
        p.spindle_rad_per_s = static_cast<float>(kRadPerS);
        p.order_step = 2;
        p.harmonics.resize(2);
        p.harmonics[1][0] = static_cast<float>(kToneN / 2);
        pieces.push_back(p);
    }
    return pieces;
}

std::vector<float> left(const std::vector<float>& interleaved) {
    std::vector<float> out;
    for (std::size_t n = 0; n < interleaved.size(); n += 2) out.push_back(interleaved[n]);
    return out;
}

// Amplitude and phase of a tone in samples whose first is at from_s.
std::complex<double> tone(std::span<const float> samples, double hz, double from_s) {
    std::complex<double> sum = 0;
    for (std::size_t n = 0; n < samples.size(); ++n) {
        const double phase = math::kTwoPi * hz * (from_s + static_cast<double>(n) / kRate);
        sum += static_cast<double>(samples[n]) * std::polar(1.0, -phase);
    }
    return 2.0 * sum / static_cast<double>(samples.size());
}

class Player {
  public:
    explicit Player(double to_s = 3) : sound(options()) {
        sound.take(protocol::LiveSoundPieces{cut(0, to_s)});
    }
    // As a page does: a state 60 times a second, up to `jitter_s` late.
    std::vector<float> play(double from_s, double seconds, double speed, double jitter_s) {
        std::vector<float> out(static_cast<std::size_t>(2 * seconds * kRate));
        double next = 0;
        std::uint32_t random = 1;
        for (std::size_t n = 0; n < out.size(); n += 256) {
            const double now = static_cast<double>(n) / 2 / kRate;
            if (now >= next) {
                random = random * 1664525u + 1013904223u;
                const double late = jitter_s * static_cast<double>(random >> 8) / (1 << 24);
                sound.follow(from_s + speed * (now - late + jitter_s / 2), speed, true);
                next += 1.0 / 60;
            }
            sound.render(std::span(out).subspan(n, std::min<std::size_t>(256, out.size() - n)));
        }
        return left(out);
    }

    LiveSound sound;
};

TEST(LiveSound, IsTheToneOfTheTeethInPhaseWithTheSpindle) {
    Player player;
    const auto samples = player.play(0, 2.5, 1, 0.004);
    const auto heard = tone(std::span(samples).subspan(kRate, kRate), kToothHz, 1);
    const double level = sound::kPascalPerNewton * kToneN / sound::kFullScalePascal;
    EXPECT_NEAR(std::abs(heard), level, 0.02 * level);

    sound::Soundtrack direct(options());
    std::vector<float> told;
    contact::ForceSpectrum spectrum;
    spectrum.order_step = 2;
    spectrum.harmonics.resize(2);
    spectrum.harmonics[1].x = kToneN / 2;
    for (const protocol::LiveSoundPiece& p : cut(0, 2.5)) {
        contact::ContactSample s;
        s.t_s = p.t_s;
        s.phase_rad = kRadPerS * p.t_s;
        s.phase_rate_rad_per_s = kRadPerS;
        s.spectrum = &spectrum;
        direct.play_to(s, [&](std::span<const float> b) { told.insert(told.end(), b.begin(), b.end()); });
    }
    const auto track = left(told);
    const auto expected = tone(std::span(track).subspan(kRate, kRate), kToothHz, 1);
    // Five degrees of the spindle are ten of two teeth.
    EXPECT_NEAR(std::arg(heard / expected), 0, 10 * math::kRadPerDeg);
    EXPECT_NEAR(player.sound.program_s(), 2.5, 0.004);
}

TEST(LiveSound, KeepsItsPitchAtOtherSpeeds) {
    for (const double speed : {0.25, 2.0}) {
        Player player;
        const auto samples = player.play(0, 1.4, speed, 0.004);
        const auto half = std::span(samples).subspan(kRate / 2, kRate / 2);
        const double level = sound::kPascalPerNewton * kToneN / sound::kFullScalePascal;
        EXPECT_NEAR(std::abs(tone(half, kToothHz, 0)), level, 0.02 * level) << speed;
    }
}

TEST(LiveSound, IsSilentWhereNothingIsCutAndWherePaused) {
    Player player(1);
    const auto over = player.play(0.9, 1, 1, 0);
    float loudest = 0;
    for (std::size_t n = kRate / 4; n < over.size(); ++n) loudest = std::max(loudest, std::abs(over[n]));
    EXPECT_EQ(loudest, 0);

    Player paused;
    paused.play(0, 1, 1, 0);
    paused.sound.follow(1, 1, false);
    std::vector<float> rest(kRate);
    paused.sound.render(rest);
    for (std::size_t n = kRate / 5; n < rest.size(); ++n) ASSERT_EQ(rest[n], 0) << n;
    EXPECT_DOUBLE_EQ(paused.sound.program_s(), 1);
}

TEST(LiveSound, DoesNotClick) {
    Player player(1);
    std::vector<float> samples = player.play(0.5, 0.3, 1, 0.004);
    player.sound.follow(0.8, 1, false);
    std::vector<float> rest(kRate / 4);
    player.sound.render(rest);
    for (const float v : left(rest)) samples.push_back(v);
    const double amplitude = sound::kPascalPerNewton * kToneN / sound::kFullScalePascal;
    const double w = math::kTwoPi * kToothHz / kRate;
    double bend = 0;
    for (std::size_t n = 1; n + 1 < samples.size(); ++n) {
        bend = std::max(bend,
                        std::abs(static_cast<double>(samples[n - 1]) - 2 * static_cast<double>(samples[n]) +
                                 static_cast<double>(samples[n + 1])));
    }
    // The tone itself bends by A w^2; an amplitude that stepped would by A.
    EXPECT_LT(bend, 3 * amplitude * w * w);
}

TEST(LiveSound, LeavesNonsenseAlone) {
    Player player;
    player.sound.follow(std::nan(""), 1, true);
    player.sound.follow(0, -1, true);
    job::Listening listening;
    listening.workshop.room = 1000;
    player.sound.take(listening);
    auto pieces = cut(0, 0.3);
    pieces[0].order_step = 0;
    pieces[0].edges = -1;
    pieces[0].harmonics.resize(5000);
    player.sound.take(protocol::LiveSoundPieces{pieces});
    player.sound.follow(0, 1, true);
    std::vector<float> out(512);
    player.sound.render(out);
    for (const float v : out) EXPECT_TRUE(std::isfinite(v));
}

}  // namespace
}  // namespace tribo::session
