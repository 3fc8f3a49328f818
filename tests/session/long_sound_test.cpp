// SPDX-License-Identifier: MIT
// Sound that goes on and on while everything changes at random: long enough to be a test, and, for
// scripts/soak.sh, for minutes or an hour.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <vector>

#include "base/noise_hash.hpp"
#include "noise/play/friction_voice.hpp"
#include "sound/play/calibration.hpp"
#include "sound/play/workshop.hpp"

namespace tribo::session {
namespace {

constexpr double kPi = std::numbers::pi, kRate = 48000;
constexpr double kMostRpm = 12000, kMostNewtons = 100;

// The parameter: seconds of sound.
class LongSound : public testing::TestWithParam<double> {};

class Random {
  public:
    explicit Random(std::uint64_t seed) : noise_(seed) {}
    double in(double low, double high) { return low + (high - low) * noise_.uniform(drawn_++); }
    bool one_in(double n) { return in(0, n) < 1; }

  private:
    CounterNoise noise_;
    std::uint64_t drawn_ = 0;
};

struct Kind {
    int flutes = 3, harmonics = 12;
    bool chips = false;
    bool leaps = false;  // places change from one moment to the next; else at up to 8 m/s
};

// A cut at random: what it does next is drawn, and how long it takes.
class RandomCut {
  public:
    RandomCut(std::uint64_t seed, const Kind& kind) : random_(seed), kind_(kind) {
        for (contact::ForceSpectrum& s : spectra_) {
            s.order_step = kind.flutes;
            s.harmonics.resize(static_cast<std::size_t>(kind.harmonics) + 1);
        }
    }
    // The next sample; what it says is valid until the one after it.
    contact::ContactSample next() {
        const double wait = random_.one_in(20) ? 0 : random_.in(0.001, 0.1);
        const double before = rate_;
        if (random_.one_in(3)) rate_ = random_.in(100, kMostRpm) / 60 * 2 * kPi;
        if (random_.one_in(30)) rate_ = 0;
        angle_ += 0.5 * (before + rate_) * wait;
        t_s_ += wait;
        contact::ForceSpectrum& spectrum = spectra_[turn_++ % 2];
        const double force_n = random_.in(0, kMostNewtons);
        spectrum.harmonics[0].torque = 50 * force_n;
        for (int n = 1; n <= kind_.harmonics; ++n) {
            const auto c = std::polar(force_n / (n * n), random_.in(0, 2 * kPi));
            spectrum.harmonics[static_cast<std::size_t>(n)] = {0.6 * c, 0.8 * c, c, c};
        }
        contact::ContactSample s;
        s.t_s = t_s_;
        if (kind_.leaps && random_.one_in(10)) {
            place_mm_ = {random_.in(-3000, 3000), random_.in(-3000, 3000), random_.in(-500, 500)};
        } else {
            const Vec3 way{random_.in(-4500, 4500), random_.in(-4500, 4500), random_.in(-4500, 4500)};
            const Vec3 to = place_mm_ + wait * way;
            if (length(to) < 3000) place_mm_ = to;
        }
        s.position_mm = place_mm_;
        s.force_n = {force_n, 0, 0};
        s.removed_mm3_per_s = kind_.chips ? random_.in(0, 1000) : 0;
        s.edges = kind_.flutes;
        s.phase_rad = angle_;
        s.phase_rate_rad_per_s = rate_;
        s.spectrum = random_.one_in(6) ? nullptr : &spectrum;
        return s;
    }

  private:
    Random random_;
    Kind kind_;
    contact::ForceSpectrum spectra_[2];
    std::size_t turn_ = 0;
    double t_s_ = 0, angle_ = 0, rate_ = 0;
    Vec3 place_mm_;
};

// What is wrong with a track: nothing, or the first of it.
class Watch {
  public:
    explicit Watch(double most_rough) : most_rough_(most_rough) {}
    void hear(std::span<const float> interleaved) {
        for (std::size_t n = 0; n < interleaved.size(); ++n) {
            const double v = static_cast<double>(interleaved[n]);
            auto& x = past_[n % 2];
            // Not a number fails every comparison.
            if (!(std::abs(v) <= 1)) ++beyond_;
            const double rough = std::abs(v - 2 * x[0] + x[1]);
            roughest_ = std::max(roughest_, rough);
            if (!(rough <= most_rough_)) ++clicks_;
            x[1] = x[0];
            x[0] = v;
            loudest_ = std::max(loudest_, std::abs(v));
        }
        frames_ += interleaved.size() / 2;
    }
    std::size_t frames() const { return frames_; }
    long beyond() const { return beyond_; }
    long clicks() const { return clicks_; }
    double roughest() const { return roughest_; }
    double loudest() const { return loudest_; }

  private:
    double most_rough_;
    double past_[2][2]{};
    long beyond_ = 0, clicks_ = 0;
    double roughest_ = 0, loudest_ = 0;
    std::size_t frames_ = 0;
};

void play(sound::Soundtrack& track, const Kind& kind, Watch& watch, double seconds) {
    RandomCut cut(1, kind);
    Random random(99);
    const auto hear = [&](std::span<const float> block) { watch.hear(block); };
    while (static_cast<double>(watch.frames()) < seconds * kRate) {
        const contact::ContactSample next = cut.next();
        if (random.one_in(200)) track.release();
        track.play_to(next, hear);
    }
    EXPECT_EQ(watch.beyond(), 0);
}

// The largest second difference of partials that are as loud as at kMostNewtons, as high as at kMostRpm times
// `pitch`, at 1 m, at the ear that hears them best.
double roughest_possible(const Kind& kind, const sound::Head& head, double pitch) {
    double most = 0;
    for (int azimuth = 0; azimuth < 360; azimuth += 5) {
        sound::EarResponses heard;
        head.hear({3 * std::sin(azimuth * kPi / 180), 3 * std::cos(azimuth * kPi / 180), 0}, heard);
        for (double hz = 500; hz < 14000; hz += 500) {
            std::complex<double> sum = 0;
            for (std::size_t k = 0; k < sound::kHeadTaps; ++k) {
                sum += std::polar(1.0, -2 * kPi * hz / kRate * static_cast<double>(k)) *
                       static_cast<double>(heard.taps[0][k]);
            }
            most = std::max(most, std::abs(sum));
        }
    }
    double sum = 0;
    for (int n = 1; n <= kind.harmonics; ++n) {
        const double w = 2 * kPi * n * kind.flutes * pitch * kMostRpm / 60 / kRate;
        const double pascal = 2 * kMostNewtons / (n * n) * sound::kPascalPerNewton;
        sum += pascal / sound::kFullScalePascal * 2 * (1 - std::cos(std::min(w, kPi)));
    }
    return most * sum;
}

TEST_P(LongSound, of_tones_from_all_around_never_clicks) {
    const Kind kind;
    sound::SoundtrackOptions options;
    options.head = sound::Head::sphere(kRate);
    // A source at 8 m/s: at most 1.05 times the pitch; amplitudes that move add a little.
    const double bound = 1.02 * roughest_possible(kind, *options.head, 1.05);
    sound::Soundtrack track(options);
    Watch watch(bound);
    play(track, kind, watch, GetParam());
    EXPECT_EQ(watch.clicks(), 0) << watch.roughest() << " where " << bound << " is possible";
    EXPECT_GT(watch.roughest(), 0.2 * bound) << "too quiet to tell";
}

TEST_P(LongSound, of_tones_that_leap_from_place_to_place_slides_and_never_clicks) {
    // Up to 1 kHz, so that four times the pitch, which is where leaps end, is still no step.
    const Kind kind{.flutes = 1, .harmonics = 5, .leaps = true};
    sound::SoundtrackOptions options;
    options.head = sound::Head::sphere(kRate);
    const double bound = 1.02 * roughest_possible(kind, *options.head, 4);
    sound::Soundtrack track(options);
    Watch watch(bound);
    play(track, kind, watch, GetParam());
    EXPECT_EQ(watch.clicks(), 0) << watch.roughest() << " where " << bound << " is possible";
    EXPECT_GT(watch.roughest(), 0.02 * bound) << "too quiet to tell";
}

TEST_P(LongSound, of_everything_at_once_stays_within_full_scale) {
    sound::SoundtrackOptions options;
    options.head = sound::Head::sphere(kRate);
    options.gain_db = 30;  // into the limiter
    options.tool = sound::tool_body(12, 60, 0.03);
    sound::Recording machine;
    machine.sample_rate_hz = 44100;
    machine.spindle_rpm = 6000;
    const CounterNoise noise(3);
    for (std::size_t n = 0; n < 44100; ++n) {
        const double t = static_cast<double>(n) / 44100;
        machine.samples.push_back(
            static_cast<float>(0.2 * std::sin(2 * kPi * 400 * t) + 0.02 * noise.gaussian(n)));
    }
    options.recording = options.idle = std::make_shared<const sound::Recording>(machine);
    for (const bool recorded : {true, false}) {
        // The spindle and half of the cut recorded, then all of it made.
        if (!recorded) options.recording = options.idle = nullptr;
        sound::apply({.machine = 3, .room = 3, .chips = sound::ChipMaterial::nickel}, options);
        sound::Soundtrack track(options);
        Watch watch(4);
        play(track, {.chips = true, .leaps = true}, watch, 0.5 * GetParam());
        EXPECT_GT(watch.loudest(), 0.75);
    }
}

noise::MaterialVoices three_speeds() {
    noise::MaterialVoices voices;
    for (const double speed : {30.0, 100.0, 300.0}) {
        noise::VoiceModel m;
        m.speed_mm_per_s = speed;
        // So low that nothing is clipped.
        m.level_db = -50 + 14 * std::log10(speed / 100);
        // Low-pass noise, so that a click would stand out.
        m.spectrum = {kRate, {-0.995, 0.98, 0.001 * speed}};
        voices.models.push_back(m);
    }
    voices.law = noise::fit_level_law(voices.models);
    return voices;
}

TEST_P(LongSound, of_rubbing_at_random_never_clicks) {
    noise::FrictionVoice voice(three_speeds());
    std::vector<float> block(128);
    double a = 0, b = 0;  // the two samples before
    const auto roughest = [&](double seconds, auto lead) {
        double worst = 0;
        for (double t = 0; t < seconds; t += 128 / kRate) {
            lead();
            voice.render(block);
            for (const float f : block) {
                const double v = static_cast<double>(f);
                const double rough = std::abs(v - 2 * a + b);
                worst = rough <= worst ? worst : rough;  // sticks at what is not a number
                b = a;
                a = v;
            }
        }
        return worst;
    };
    // The roughest sample of as long a time of the loudest steady rubbing, and a decibel.
    const double steady = roughest(std::max(60.0, GetParam()), [&] { voice.set_target(600, 3); });
    Random random(5);
    const double stepped = roughest(GetParam(), [&] {
        if (random.one_in(6)) voice.set_target(random.one_in(9) ? 0 : random.in(0, 600), random.in(-0.3, 3));
    });
    EXPECT_LT(20 * std::log10(stepped / steady), 1);
    EXPECT_GT(stepped, 0.5 * steady);
}

INSTANTIATE_TEST_SUITE_P(Seconds, LongSound, testing::Values(10.0));
INSTANTIATE_TEST_SUITE_P(DISABLED_Minutes, LongSound, testing::Values(180.0));
INSTANTIATE_TEST_SUITE_P(DISABLED_Hour, LongSound, testing::Values(3600.0));

}  // namespace
}  // namespace tribo::session
