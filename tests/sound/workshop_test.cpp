// SPDX-License-Identifier: MIT
// What stands around a cut: machines, their spindles, and the room.
#include "sound/play/workshop.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>

#include "base/math.hpp"
#include "noise/play/pink_noise.hpp"
#include "sound/cut/machine_voice.hpp"
#include "sound/cuts.hpp"
#include "sound/place/room.hpp"

namespace tribo::sound {
namespace {

using test::cut_at;
using test::falling_spectrum;
using test::track_of;

constexpr double kRate = 48000;

// A slot in steel: mean torque 5 Nm at 4500 rpm, 2356 W.
contact::ForceSpectrum working_spectrum(double torque_nmm = 5000) {
    contact::ForceSpectrum s = falling_spectrum(5, 8, 40);
    s.harmonics[0].torque = torque_nmm;
    return s;
}

std::vector<contact::ContactSample> steady(const contact::ForceSpectrum* spectrum, double rpm, double to_s,
                                           double removal = 0, int edges = 0) {
    std::vector samples{cut_at(0, spectrum, rpm, removal), cut_at(to_s, spectrum, rpm, removal)};
    for (contact::ContactSample& s : samples) s.edges = edges;
    return samples;
}

double level(const std::vector<float>& wave) {
    return test::rms(std::span(wave).subspan(9600, wave.size() - 24000));
}

TEST(Machines, all_have_names_spectra_and_levels_of_their_own) {
    ASSERT_GE(machines().size(), 4u);
    EXPECT_EQ(machines()[0].name, "none");
    const contact::ForceSpectrum spectrum = working_spectrum();
    for (std::size_t n = 1; n < machines().size(); ++n) {
        const Machine& machine = machines()[n];
        EXPECT_FALSE(machine.name.empty() || machine.what.empty());
        SoundtrackOptions options;
        apply({.machine = n}, options);
        const double idle = level(track_of(steady(nullptr, machine.spindle.rpm, 4), 4, options));
        EXPECT_NEAR(idle * kFullScalePascal / machine.spindle.pa, 1, 0.1) << machine.name;
        const double cut = level(track_of(steady(&spectrum, 4500, 4), 4, options));
        EXPECT_GT(cut * kFullScalePascal, 0.3) << machine.name;
        EXPECT_LT(cut * kFullScalePascal, 3) << machine.name;
    }
}

TEST(Machine, makes_noise_of_the_cutting_power) {
    // sqrt(share W z / (4 pi)), whatever the body does to its colour.
    for (const double torque : {500.0, 5000.0}) {
        for (const double rpm : {3000.0, 12000.0}) {
            contact::ForceSpectrum spectrum;
            spectrum.harmonics.resize(1);
            spectrum.harmonics[0].torque = torque;
            SoundtrackOptions options;
            apply({.machine = 1, .spindle_db = -60}, options);
            const double watts = torque / 1000 * rpm / 60 * 2 * std::numbers::pi;
            const double expected = std::sqrt(kSoundShare * watts * kAirImpedance / (4 * std::numbers::pi));
            const double found = level(track_of(steady(&spectrum, rpm, 10), 10, options)) * kFullScalePascal;
            EXPECT_NEAR(found / expected, 1, 0.05) << torque << ' ' << rpm;
        }
    }
}

TEST(Machine, none_is_the_force_alone) {
    const contact::ForceSpectrum spectrum = working_spectrum();
    SoundtrackOptions options;
    apply({}, options);
    EXPECT_EQ(track_of(steady(&spectrum, 4500, 1, 500, 5), 1, options),
              track_of(steady(&spectrum, 4500, 1, 500, 5), 1));
}

TEST(Machine, keeps_the_teeth_at_their_frequencies) {
    const contact::ForceSpectrum spectrum = working_spectrum(0);
    SoundtrackOptions options;
    apply({.machine = 1, .spindle_db = -60}, options);
    BodyFilter body;
    body.set(options.machine.radiation, kRate);
    const std::vector<float> wave = track_of(steady(&spectrum, 4500, 2.2), 2.2, options);
    const std::span<const float> middle = std::span(wave).subspan(4800, 96000);
    for (int n = 1; n <= 8; ++n) {
        const double expected = 80.0 / n * test::kSamplePerNewton * body.gain_at(375 * n);
        EXPECT_NEAR(test::tone_amplitude(middle, 375 * n, kRate) / expected, 1, 2e-3) << n;
    }
}

TEST(Machine, keeps_the_teeth_at_their_frequencies_to_a_hundred_thousandth) {
    const contact::ForceSpectrum spectrum = working_spectrum(0);
    SoundtrackOptions options;
    apply({.machine = 1, .spindle_db = -60}, options);
    const std::vector<float> wave = track_of(steady(&spectrum, 4500, 6), 6, options);
    // How far a line turns against its own frequency from one second to another, 4 s later.
    const auto turn = [&](std::size_t from, double hz) {
        std::complex<double> sum = 0;
        for (std::size_t n = 0; n < 48000; ++n) {
            const double hann =
                0.5 - 0.5 * std::cos(2 * std::numbers::pi * (static_cast<double>(n) + 0.5) / 48000);
            sum += hann * static_cast<double>(wave[from + n]) *
                   std::polar(1.0, -2 * std::numbers::pi * hz * static_cast<double>(from + n) / kRate);
        }
        return std::arg(sum);
    };
    for (int n = 1; n <= 8; ++n) {
        const double hz = 375.0 * n;
        const double off = std::remainder(turn(48000 * 5, hz) - turn(48000, hz), 2 * std::numbers::pi);
        EXPECT_LT(std::abs(off) / (2 * std::numbers::pi * 4) / hz, 1e-5) << hz;
    }
}

TEST(Machine, sounds_louder_where_the_force_says_so) {
    const auto loud = [](double force, double torque, double removal) {
        contact::ForceSpectrum spectrum = falling_spectrum(5, 8, force);
        spectrum.harmonics[0].torque = torque;
        SoundtrackOptions options;
        apply({.machine = 1, .chips = ChipMaterial::steel}, options);
        return test::decibel(level(track_of(steady(&spectrum, 4500, 4, removal, 5), 4, options)));
    };
    const double usual = loud(40, 5000, 600);
    EXPECT_NEAR(loud(80, 10000, 1200) - usual, 3, 1.2);  // twice the depth
    EXPECT_GT(loud(50, 7000, 600), usual + 1);           // dull: more force for the same chips
    EXPECT_LT(loud(4, 500, 60), usual - 8);              // a finishing pass
}

TEST(MachineVoice, has_its_lines_at_their_orders_and_follows_the_spindle) {
    SpindleSound spindle;
    spindle.pa = 0.1;
    spindle.rpm = 6000;
    spindle.exponent = 1;
    spindle.tonal = 1;
    spindle.lines = {{{2, 3}, {8.4, 4}}};
    for (const double rpm : {3000.0, 6000.0}) {
        MachineVoice voice({.spindle = spindle});
        contact::ContactSample idle;
        idle.phase_rate_rad_per_s = rpm / 60 * 2 * std::numbers::pi;
        voice.excite(idle, 0);
        std::vector<float> wave;
        for (int n = 0; n < 1000; ++n) {
            Quantum q{};
            voice.add(q);
            for (const double v : q) wave.push_back(static_cast<float>(v));
        }
        const std::span<const float> middle = std::span(wave).subspan(16000, 48000);
        const double rms = 0.1 * rpm / 6000;
        EXPECT_NEAR(test::tone_amplitude(middle, 2 * rpm / 60, kRate), std::sqrt(2.0) * rms * 3 / 5, 1e-4);
        EXPECT_NEAR(test::tone_amplitude(middle, 8.4 * rpm / 60, kRate), std::sqrt(2.0) * rms * 4 / 5, 1e-4);
        EXPECT_LT(test::tone_amplitude(middle, 5 * rpm / 60, kRate), 1e-5);
        // A ramp of the speed and the end of it are no clicks.
        const double steady = test::roughest(middle);
        voice.excite(idle, 100);
        idle.phase_rate_rad_per_s *= 0.5;
        voice.excite(idle, 100);
        wave.clear();
        for (int n = 0; n < 400; ++n) {
            Quantum q{};
            if (n == 200) voice.release();
            voice.add(q);
            for (const double v : q) wave.push_back(static_cast<float>(v));
        }
        EXPECT_LT(test::roughest(wave), 1.2 * steady);
        EXPECT_EQ(wave.back(), 0);
    }
}

TEST(MachineVoice, leaves_a_cut_to_the_recording_that_holds_its_machine) {
    MachineVoice voice({.spindle = machines()[1].spindle, .share_in_cut = 0});
    const contact::ForceSpectrum spectrum = working_spectrum();
    contact::ContactSample moment = cut_at(0, nullptr, 6000);
    double idle = 0, cut = 0;
    for (int n = 0; n < 800; ++n) {
        if (n == 0) voice.excite(moment, 0);
        if (n == 400) {
            moment.spectrum = &spectrum;
            voice.excite(moment, 0);
        }
        Quantum q{};
        voice.add(q);
        for (const double v : q) (n < 400 ? idle : cut) += n % 400 < 200 ? 0 : v * v;
    }
    EXPECT_GT(idle, 0);
    EXPECT_LT(cut, 1e-12 * idle);
}

TEST(Body, passes_pink_noise_with_the_gain_that_it_says) {
    for (const Machine& machine : machines()) {
        BodyFilter body;
        body.set(machine.radiation, kRate);
        noise::PinkNoise pink(11, kRate);
        double sum = 0;
        constexpr int kQuanta = 60 * 750;
        for (int n = 0; n < kQuanta; ++n) {
            Quantum q;
            std::ranges::copy(pink.block(static_cast<std::uint64_t>(n)), q.begin());
            body.apply(q);
            for (const double v : q) sum += v * v;
        }
        EXPECT_NEAR(std::sqrt(sum / (kQuanta * kQuantumFrames)) / body.gain_of_pink(), 1, 0.03)
            << machine.name;
    }
}

TEST(Body, rings_on_for_as_long_as_its_slowest_mode) {
    Body body;
    body.direct = 0;
    body.modes[0] = {200, 0.02, 1};
    EXPECT_NEAR(ring_seconds(body), 6.9078 / (2 * std::numbers::pi * 200 * 0.02), 1e-3);
    body.modes[0].hz = 0.1;
    EXPECT_EQ(ring_seconds(body), kLongestRingSeconds);
    EXPECT_EQ(ring_seconds(Body{}), 0);
    const Body both = with_modes(body, tool_body(12, 60, 0.03), 0.5);
    EXPECT_EQ(both.modes[0].hz, 0.1);
    EXPECT_EQ(both.modes[1].gain, 0.5);
    EXPECT_EQ(both.modes[3].hz, 0);
}

// A click from a place in a room, as a pair of ears hears it.
struct Echoes {
    std::vector<float> left, right;
};
Echoes echoes(const Room& room, Vec3 source, Vec3 listener, double ears_apart, int quanta = 60) {
    RoomReflections reflections(room, {0, 0, 0}, kRate, ears_apart);
    Listener ears;
    ears.position_m = listener;
    Echoes heard;
    for (int n = 0; n < quanta; ++n) {
        Quantum q{};
        if (n == 0) q[0] = 1;
        Ears out;
        reflections.add(q, source, ears, out);
        heard.left.insert(heard.left.end(), out.left.begin(), out.left.end());
        heard.right.insert(heard.right.end(), out.right.begin(), out.right.end());
    }
    return heard;
}

RC_GTEST_PROP(Room, sends_each_wall_back_at_its_time_and_level, ()) {
    const auto in = [](double from, double to) {
        return from + (to - from) * *rc::gen::inRange(0, 10001) / 10000;
    };
    Room room;
    room.low_m = {-in(1, 4), -in(1, 4), -in(1, 2)};
    room.high_m = {in(1, 4), in(1, 4), in(1, 2)};
    room.reflection = 0.5;
    room.highest_hz = 1e9;
    const Vec3 source{in(-0.9, 0.9), in(-0.9, 0.9), in(-0.9, 0.9)};
    const Vec3 listener{in(-0.9, 0.9), in(-0.9, 0.9), in(-0.9, 0.9)};
    const Echoes heard = echoes(room, source, listener, 0);
    // The way over a wall: as far across as both stand from it.
    std::vector<double> expected(heard.left.size());
    const double lows[] = {room.low_m.x, room.low_m.y, room.low_m.z};
    const double highs[] = {room.high_m.x, room.high_m.y, room.high_m.z};
    const double s[] = {source.x, source.y, source.z}, l[] = {listener.x, listener.y, listener.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double wall : {lows[axis], highs[axis]}) {
            double squared = 0;
            for (std::size_t other = 0; other < 3; ++other) {
                const double d =
                    other == axis ? std::abs(s[axis] - wall) + std::abs(l[axis] - wall) : s[other] - l[other];
                squared += d * d;
            }
            const double way = std::sqrt(squared);
            const auto at = static_cast<std::size_t>((way / kSoundSpeed + kEarLeadSeconds) * kRate + 0.5);
            if (at < expected.size()) expected[at] += 0.5 / std::max(way, 1.0);
        }
    }
    for (std::size_t n = 0; n < expected.size(); ++n) {
        const double mono = 0.5 * (static_cast<double>(heard.left[n]) + static_cast<double>(heard.right[n]));
        RC_ASSERT(std::abs(mono - expected[n]) < 1e-6);
    }
}

TEST(Room, is_symmetric_and_comes_first_to_the_nearer_ear) {
    Room room{"", "", {-3, -50, -50}, {60, 50, 50}, 1, 1e9, 1};  // one wall, to the left
    const Echoes heard = echoes(room, {0, 0, 0}, {0, 0, 0}, 0.17);
    const auto first = [](const std::vector<float>& x) {
        std::size_t n = 0;
        while (n < x.size() && x[n] == 0) ++n;
        return n;
    };
    EXPECT_NEAR(static_cast<double>(first(heard.right)) - static_cast<double>(first(heard.left)),
                0.17 / kSoundSpeed * kRate, 1);
    EXPECT_GT(heard.left[first(heard.left)], heard.right[first(heard.right)]);
    std::swap(room.low_m.x, room.high_m.x);
    room.low_m.x *= -1;
    room.high_m.x *= -1;
    const Echoes mirrored = echoes(room, {0, 0, 0}, {0, 0, 0}, 0.17);
    EXPECT_EQ(heard.left, mirrored.right);
    EXPECT_EQ(heard.right, mirrored.left);
}

TEST(Room, does_not_click_where_source_and_listener_move_and_ends_in_silence) {
    const Room& room = rooms()[1];
    RoomReflections reflections(room, {0, 0, 0}, kRate, 0.17);
    std::vector<float> wave;
    double phase = 0;
    for (int n = 0; n < 3000; ++n) {
        Quantum q{};
        for (double& v : q) v = n < 2000 ? std::sin(phase += 2 * std::numbers::pi * 300 / kRate) : 0;
        Listener ears;
        ears.position_m = {0.001 * n, 0, 0};
        Ears out;
        // Beyond the walls too.
        reflections.add(q, {0.004 * n - 4, 0.002 * n, 0}, ears, out);
        if (n > 100) wave.insert(wave.end(), out.left.begin(), out.left.end());
    }
    const double w = 2 * std::numbers::pi * 300 / kRate;
    EXPECT_GT(test::rms(std::span(wave).subspan(0, 48000)), 0.01);
    EXPECT_LT(test::roughest(wave), 6 * w * w);
    EXPECT_EQ(wave.back(), 0);
    EXPECT_FALSE(reflections.sounding());
}

TEST(Workshop, refuses_what_does_not_exist) {
    EXPECT_TRUE(is_valid({.machine = 1, .room = 1, .chips = ChipMaterial::nickel}));
    EXPECT_FALSE(is_valid({.machine = 99}));
    EXPECT_FALSE(is_valid({.room = 99}));
    EXPECT_FALSE(is_valid({.chips = static_cast<ChipMaterial>(9)}));
    EXPECT_FALSE(is_valid({.cut_db = std::nan("")}));
    EXPECT_FALSE(is_valid({.room_db = 61}));
}

}  // namespace
}  // namespace tribo::sound
