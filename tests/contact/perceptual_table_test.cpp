// SPDX-License-Identifier: MIT
#include "contact/perceptual_table.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "contact/jnd_profile.hpp"

namespace tribo::contact {
namespace {

DenseFunction sampled(double from, double to, std::size_t count, double (*f)(double)) {
    DenseFunction dense;
    for (std::size_t n = 0; n < count; ++n) {
        const double at = from + (to - from) * static_cast<double>(n) / static_cast<double>(count - 1);
        dense.at.push_back(at);
        dense.values.push_back(f(at));
    }
    return dense;
}

// One JND is a difference of one.
double absolute(std::span<const double> truth, std::span<const double> shown) {
    double worst = 0;
    for (std::size_t c = 0; c < truth.size(); ++c) worst = std::max(worst, std::abs(truth[c] - shown[c]));
    return worst;
}

double weber(std::span<const double> truth, std::span<const double> shown) {
    return std::abs(truth[0] - shown[0]) / (0.07 * std::max(1e-3, std::abs(truth[0])));
}

TEST(PerceptualTable, takes_two_knots_for_a_straight_line_whatever_its_length) {
    const DenseFunction line = sampled(0, 100, 5001, [](double x) { return 3 * x - 7; });
    const PerceptualTable table = build_perceptual_table(line, absolute, 0.01);
    EXPECT_EQ(table.knots(), 2U);
    PerceptualTable::Cursor cursor;
    double value = 0;
    ASSERT_TRUE(table.look_up(12.34, {&value, 1}, cursor));
    EXPECT_NEAR(value, 3 * 12.34 - 7, 1e-4);
    EXPECT_FALSE(table.look_up(-0.001, {&value, 1}, cursor));
    EXPECT_FALSE(table.look_up(100.001, {&value, 1}, cursor));
}

// Straight pieces between knots on a parabola x^2 miss it by (spacing / 2)^2.
TEST(PerceptualTable, spaces_knots_on_a_parabola_as_the_closed_form_says) {
    const DenseFunction parabola = sampled(0, 10, 10'001, [](double x) { return x * x; });
    const double most = 0.01, spacing = 2 * std::sqrt(most);
    const PerceptualTable table = build_perceptual_table(parabola, absolute, most);
    EXPECT_LE(worst_error_jnd(table, parabola, absolute), most * 1.001);
    EXPECT_NEAR(static_cast<double>(table.knots() - 1), 10 / spacing, 1.01);
    EXPECT_NEAR(static_cast<double>(uniform_knots(parabola, absolute, most) - 1), 10 / spacing, 1.01);
}

// exp(x) over 0..12 by Weber's law wants the same spacing everywhere; sampled by absolute error at its end it
// would take a hundred times more at its beginning. A burst in a quiet function is the other way round.
TEST(PerceptualTable, beats_even_spacing_where_a_function_bends_in_one_place_only) {
    const DenseFunction burst =
        sampled(0, 100, 20'001, [](double x) { return 1 + 5 * std::exp(-0.5 * (x - 50) * (x - 50)); });
    const PerceptualTable table = build_perceptual_table(burst, weber);
    EXPECT_LE(worst_error_jnd(table, burst, weber), kInaudibleJnd * 1.001);
    EXPECT_GE(uniform_knots(burst, weber), 5 * table.knots());
}

TEST(PerceptualTable, keeps_a_jump_between_pieces) {
    DenseFunction step;
    step.at = {0, 1, 2, 2, 3, 5, 6};
    step.values = {1, 1, 1, 9, 9, 4, 4};
    step.piece_starts = {0, 3, 5};  // the cut pauses between 3 and 5
    const PerceptualTable table = build_perceptual_table(step, absolute);
    ASSERT_EQ(table.pieces().size(), 3U);
    EXPECT_EQ(worst_error_jnd(table, step, absolute), 0);
    PerceptualTable::Cursor cursor;
    double value = 0;
    ASSERT_TRUE(table.look_up(1.999, {&value, 1}, cursor));
    EXPECT_EQ(value, 1);
    ASSERT_TRUE(table.look_up(2.001, {&value, 1}, cursor));
    EXPECT_EQ(value, 9);
    EXPECT_FALSE(table.look_up(4, {&value, 1}, cursor));
    ASSERT_TRUE(table.look_up(5.5, {&value, 1}, cursor));
    EXPECT_EQ(value, 4);
}

// Difference of levels in JNDs; one channel, an amplitude > 0.
ErrorInJnd level_error(const JndProfile& profile) {
    return [jnd_db = profile.sound_level_db](std::span<const double> truth, std::span<const double> shown) {
        return std::abs(20 * std::log10(shown[0] / truth[0])) / jnd_db;
    };
}

// Ratio of frequencies in JNDs; one channel, a factor > 0.
ErrorInJnd pitch_error(const JndProfile& profile) {
    return [jnd = profile.pitch](std::span<const double> truth, std::span<const double> shown) {
        return std::abs(shown[0] / truth[0] - 1) / jnd;
    };
}

// Rolloff 1/r from 5 cm to 5 m, and the pitch of a tool that passes a listener at 10 m/s in 0.2 m: the other
// users.
TEST(PerceptualTable, serves_rolloff_and_doppler_too) {
    const JndProfile profile;
    const DenseFunction rolloff = sampled(0.05, 5, 20'001, [](double r) { return 1 / r; });
    const PerceptualTable loudness = build_perceptual_table(rolloff, level_error(profile));
    EXPECT_LE(worst_error_jnd(loudness, rolloff, level_error(profile)), kInaudibleJnd * 1.001);
    EXPECT_GE(uniform_knots(rolloff, level_error(profile)), 5 * loudness.knots());
    const DenseFunction passing = sampled(-2, 2, 20'001, [](double t_s) {
        const double along = 10 * t_s, away = std::sqrt(along * along + 0.04);
        return 1 / (1 + 10 / 343.0 * along / away);
    });
    const PerceptualTable pitch = build_perceptual_table(passing, pitch_error(profile));
    EXPECT_LE(worst_error_jnd(pitch, passing, pitch_error(profile)), kInaudibleJnd * 1.001);
    EXPECT_GE(uniform_knots(passing, pitch_error(profile)), 5 * pitch.knots());
}

RC_GTEST_PROP(PerceptualTable, stays_within_the_error_for_any_function_and_any_cursor, ()) {
    DenseFunction f;
    f.channels = 2;
    const int count = 2 + *rc::gen::inRange(0, 200);
    const auto number = rc::gen::map(rc::gen::inRange(-1000, 1000), [](int n) { return n / 100.0; });
    for (int n = 0; n < count; ++n) {
        f.at.push_back((f.at.empty() ? 0 : f.at.back()) + (1 + *rc::gen::inRange(0, 50)) / 10.0);
        f.values.push_back(*number);
        f.values.push_back(*number);
    }
    const double most = (1 + *rc::gen::inRange(0, 100)) / 10.0;
    const PerceptualTable table = build_perceptual_table(f, absolute, most);
    RC_ASSERT(parts_are_sound(table.parts()));
    RC_ASSERT(worst_error_jnd(table, f, absolute, 8) <= most + 1e-5);
    // A cursor that was anywhere gives what a fresh one gives.
    PerceptualTable::Cursor used;
    for (int n = 0; n < 50; ++n) {
        const double at = f.at.back() * (*rc::gen::inRange(0, 1001)) / 1000.0;
        PerceptualTable::Cursor fresh;
        double a[2] = {0, 0}, b[2] = {0, 0};
        RC_ASSERT(table.look_up(at, a, used) == table.look_up(at, b, fresh));
        RC_ASSERT(a[0] == b[0] && a[1] == b[1]);
    }
}

}  // namespace
}  // namespace tribo::contact
