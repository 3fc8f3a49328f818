// SPDX-License-Identifier: MIT
#include "sound/place/spatial_source.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/math.hpp"
#include "sound/cuts.hpp"
#include "sound/ears.hpp"

namespace tribo::sound {
namespace {

using test::circling;
using test::hear;
using test::Heard;
using test::phasor;
using test::sphere;
using test::standing;
using test::tone;

constexpr double kSourceRate = test::kEarRate;

std::span<const float> late(const std::vector<float>& x, std::size_t count) {
    return std::span(x).last(count);
}

TEST(SpatialSource, that_circles_the_head_leaves_no_stray_energy) {
    for (const auto& head : {sphere(), Head::panning(kSourceRate)}) {
        SpatialSource source(head);
        const Heard heard = hear(source, 3000, tone(1000), circling(2, 2));
        EXPECT_LT(test::stray_db(late(heard.left, 1 << 17), 1000), -75);
        EXPECT_LT(test::stray_db(late(heard.right, 1 << 17), 1000), -75);
    }
    // Ten times as fast still keeps what the issue asks of the slow one.
    SpatialSource source(sphere());
    const Heard fast = hear(source, 3000, tone(1000), circling(0.5, 0.2));
    EXPECT_LT(test::stray_db(late(fast.left, 1 << 17), 1000), -60);
}

TEST(SpatialSource, loses_6_02_dB_per_doubling_of_the_distance_and_nothing_within_a_metre) {
    const auto level = [](double metres) {
        SpatialSource source(sphere());
        const Heard heard = hear(source, 300, tone(750), standing({0, metres, 0}));
        return test::decibel(std::abs(phasor(late(heard.left, 4096), 750)));
    };
    const double at_1 = level(1);
    for (const double metres : {2.0, 4.0, 8.0, 16.0}) {
        EXPECT_NEAR(at_1 - level(metres), 20 * std::log10(metres), 0.001) << metres;
    }
    EXPECT_NEAR(level(0.3), at_1, 0.001);
}

TEST(SpatialSource, sounds_as_late_as_the_air_brings_it) {
    const auto phase = [](double metres) {
        SpatialSource source(sphere());
        const Heard heard = hear(source, 300, tone(500), standing({0, metres, 0}));
        return std::arg(phasor(late(heard.left, 9600), 500));
    };
    const double start = phase(1);
    for (const double metres : {1.1, 1.2345, 3.0, 11.0, 40.0}) {
        const double turns = (metres - 1) / kSoundSpeed * 500;
        EXPECT_NEAR(std::remainder(start - phase(metres) - 2 * math::kPi * turns, 2 * math::kPi), 0, 2e-3)
            << metres;
    }
}

// The frequency that is heard, from the phase over `seconds` of it.
double pitch(std::span<const float> x, double hz) {
    double best = hz;
    for (int round = 0; round < 4; ++round) {
        const std::size_t half = x.size() / 2;
        const double turn =
            std::arg(phasor(x.subspan(half, half), best) / phasor(x.first(half), best) *
                     std::polar(1.0, -2 * math::kPi * best / kSourceRate * static_cast<double>(half)));
        best += turn / (2 * math::kPi) * kSourceRate / static_cast<double>(half);
    }
    return best;
}

TEST(SpatialSource, shifts_pitch_by_the_ratio_of_speeds_to_the_speed_of_sound) {
    const double c = kSoundSpeed;
    const auto heard_hz = [](double source_speed, double listener_speed) {
        // Both along +y; the source ahead of the listener.
        SpatialSource source(sphere());
        const auto place = [=](double t) { return Vec3{0, 20 + source_speed * (t - 0.5), 0}; };
        const auto listener = [=](double t) {
            Listener l;
            l.position_m = {0, listener_speed * (t - 0.5), 0};
            return l;
        };
        const Heard heard = hear(source, 600, tone(1000), place, listener);
        return pitch(late(heard.left, 16384), 1000 * (1 + listener_speed / 343) / (1 + source_speed / 343));
    };
    for (const auto& [source, listener] : {std::pair{20.0, 0.0},
                                           {-20.0, 0.0},
                                           {0.0, 20.0},
                                           {0.0, -20.0},
                                           {-20.0, 20.0},
                                           {20.0, 20.0},
                                           {0.05, 0.0},
                                           {-60.0, 0.0}}) {
        const double expected = 1000 * (c + listener) / (c + source);
        EXPECT_NEAR(heard_hz(source, listener) / expected, 1, 2e-5) << source << " " << listener;
    }
}

TEST(SpatialSource, hears_a_turned_head_like_a_turned_world) {
    const Vec3 place{1.3, -0.4, 0.7};
    SpatialSource a(sphere()), b(sphere());
    Listener turned;  // to the right by 90 degrees
    turned.forward = {1, 0, 0};
    const Heard world = hear(a, 200, tone(900), standing({-place.y, place.x, place.z}));
    const Heard head = hear(b, 200, tone(900), standing(place), [&](double) { return turned; });
    for (std::size_t n = 0; n < world.left.size(); ++n) {
        ASSERT_NEAR(world.left[n], head.left[n], 1e-5) << n;
        ASSERT_NEAR(world.right[n], head.right[n], 1e-5) << n;
    }
}

TEST(SpatialSource, crosses_the_middle_of_the_head_without_a_step) {
    SpatialSource source(sphere());
    const Heard heard = hear(source, 1500, tone(200), [](double t) { return Vec3{0.2 * (t - 1), 0, 0}; });
    const double w = 2 * math::kPi * 200 / kSourceRate;
    for (const std::vector<float>* ear : {&heard.left, &heard.right}) {
        EXPECT_LT(test::roughest(std::span(*ear).subspan(2000)), 3 * w * w);
    }
    // From left to right: the ears change places.
    const auto right_before_left = [&](std::size_t from) {
        const auto part = [&](const std::vector<float>& x) { return std::span(x).subspan(from, 4800); };
        return std::arg(phasor(part(heard.right), 200) / phasor(part(heard.left), 200));
    };
    EXPECT_LT(right_before_left(3000), -0.5);
    EXPECT_GT(right_before_left(90000), 0.5);
}

TEST(SpatialSource, follows_a_leap_through_the_sound_barrier_without_a_click) {
    // 30 m in one quantum, and back: pitch slides by at most two octaves while the delay catches up.
    SpatialSource source(sphere());
    const Heard heard =
        hear(source, 1500, tone(300), [](double t) { return Vec3{0, t > 0.5 && t < 1 ? 31.0 : 1.0, 0}; });
    const double w = 4 * 2 * math::kPi * 300 / kSourceRate;
    EXPECT_LT(test::roughest(std::span(heard.left).subspan(2000)), 1.6 * w * w);
    for (const float v : heard.left) ASSERT_TRUE(std::isfinite(v));
}

TEST(SpatialSource, is_silent_before_the_sound_arrives_and_after_it_has_passed) {
    SpatialSource source(sphere());
    // 10 m: 29.15 ms, 1399 frames.
    const Heard heard = hear(
        source, 200, [](double frame) { return frame < 1000 ? std::sin(0.3 * frame) : 0; },
        standing({0, 10, 0}));
    for (std::size_t n = 0; n < 1390; ++n) ASSERT_EQ(heard.left[n], 0) << n;
    EXPECT_GT(test::rms(std::span(heard.left).subspan(1600, 600)), 0.05);
    EXPECT_FALSE(source.sounding());
    EXPECT_EQ(source.seconds_to_silence(), 0);
    for (std::size_t n = 3000; n < heard.left.size(); ++n) ASSERT_EQ(heard.left[n], 0) << n;
}

RC_GTEST_PROP(SpatialSource, stays_finite_and_bounded_wherever_it_is_put, ()) {
    static const auto heads = {sphere(), Head::panning(kSourceRate)};
    for (const auto& head : heads) {
        SpatialSource source(head);
        Ears ears;
        for (int q = 0; q < 60; ++q) {
            const auto any = [](int most) { return *rc::gen::inRange(-most, most + 1) / 10.0; };
            Listener listener;
            listener.position_m = {any(30), any(30), any(30)};
            listener.forward = {any(2), any(2), any(2)};
            listener.up = {any(2), any(2), any(2)};
            Quantum loud;
            loud.fill(any(10));
            const int far = *rc::gen::element(1, 10, 1000, 1000000);
            ears = {};
            source.add(loud, {any(far), any(far), any(far)}, listener, ears);
            for (const float v : ears.left) RC_ASSERT(std::abs(v) < 20);
            for (const float v : ears.right) RC_ASSERT(std::abs(v) < 20);
        }
    }
}

}  // namespace
}  // namespace tribo::sound
