// SPDX-License-Identifier: MIT
#include "contact/force_table.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"

namespace tribo::contact {
namespace {

// A cut that is 0.5 mm rows of a force that swells slowly, at `rpm` with `flutes` teeth.
std::vector<ForceStretch> swelling_cut(double rpm, int flutes, int rows, double tooth_share = 0.5) {
    std::vector<ForceStretch> stretches;
    const double rate = rpm / 60 * math::kTwoPi, row_s = 0.03;
    for (int n = 0; n < rows; ++n) {
        ForceStretch s;
        s.start_s = n * row_s;
        s.end_s = (n + 1) * row_s;
        s.rate_rad_per_s = rate;
        s.phase_rad = rate * s.start_s;
        const double size = 200 + 100 * std::sin(0.05 * n);
        s.spectrum.order_step = flutes;
        s.spectrum.harmonics.resize(4);
        s.spectrum.harmonics[0].x = size;
        s.spectrum.harmonics[0].y = 0.3 * size;
        // Half of the amplitude: the spectrum counts both signs of frequency.
        s.spectrum.harmonics[1].x = 0.5 * tooth_share * size;
        s.spectrum.harmonics[2].y = {0, 0.1 * tooth_share * size};
        stretches.push_back(s);
    }
    return stretches;
}

TEST(ForceTable, stays_within_half_a_jnd_of_every_row_and_of_what_lies_between) {
    const auto cut = swelling_cut(6000, 2, 1000);
    const ForceTableOptions options;
    const ForceFunction function = force_function(cut, options);
    const ForceTable table = build_force_table(function, options);
    EXPECT_EQ(table.table().pieces().size(), 1U);
    EXPECT_LE(worst_error_jnd(table.table(), function.dense, force_error(options), 8), 0.5 * 1.001);
    EXPECT_LT(table.table().knots(), cut.size() / 5);
}

TEST(ForceTable, sums_the_harmonics_as_the_spectrum_itself_does) {
    const auto cut = swelling_cut(600, 2, 3);
    ForceTableOptions options;
    options.most_jnd = 1e-9;
    const ForceTable table = build_force_table(force_function(cut, options), options);
    ForceTable::Cursor cursor;
    for (int n = 0; n < 50; ++n) {
        // In the middle of a row the table holds its spectrum.
        const ForceStretch& row = cut[1];
        const double t_s = 0.5 * (row.start_s + row.end_s);
        Vec3 force;
        ASSERT_TRUE(table.force_at(t_s, 10'000, cursor, force));
        const ToolForce expected =
            evaluate(row.spectrum, row.phase_rad + row.rate_rad_per_s * (t_s - row.start_s));
        EXPECT_NEAR(force.x, expected.force_n.x, 1e-4);
        EXPECT_NEAR(force.y, expected.force_n.y, 1e-4);
        EXPECT_NEAR(force.z, 0, 1e-4);
    }
}

// The case: 4 flutes at 12,000 rpm make 800 Hz, which a 1 kHz servo would show as 200 Hz.
TEST(ForceTable, leaves_less_than_a_hundredth_of_the_tooth_force_as_false_low_force) {
    std::vector<ForceStretch> cut = swelling_cut(12'000, 4, 100, 1.0);
    for (ForceStretch& s : cut) {  // a steady cut
        s.spectrum.harmonics[0].x = 200;
        s.spectrum.harmonics[0].y = 60;
        s.spectrum.harmonics[1].x = 100;
        s.spectrum.harmonics[2].y = {0, 20};
    }
    const ForceTableOptions options;
    const ForceTable table = build_force_table(force_function(cut, options), options);
    ForceTable::Cursor cursor;
    double swing = 0, naive = 0;
    for (int k = 0; k < 2000; ++k) {
        const double t_s = 0.1 + k * 1e-3;
        Vec3 force;
        ASSERT_TRUE(table.force_at(t_s, 1000, cursor, force));
        swing = std::max(swing, length(force - Vec3{200, 60, 0}));
        const ForceStretch& s = cut[0];
        const ToolForce sampled = evaluate(s.spectrum, s.rate_rad_per_s * t_s);
        naive = std::max(naive, length(sampled.force_n - Vec3{200, 60, 0}));
    }
    EXPECT_LT(swing, 0.01 * 200);  // of the tooth's 200 N amplitude
    EXPECT_GT(naive, 0.5 * 200);   // what a servo that samples the force itself would shake with
}

TEST(ForceTable, carries_a_tooth_frequency_that_the_servo_can_show) {
    const auto cut = swelling_cut(3000, 2, 100, 1.0);  // 100 Hz
    const ForceTableOptions options;
    const ForceTable table = build_force_table(force_function(cut, options), options);
    ForceTable::Cursor cursor;
    double low = 1e9, high = -1e9;
    for (int k = 0; k < 30; ++k) {
        Vec3 force;
        ASSERT_TRUE(table.force_at(0.5 + k * 1e-3, 1000, cursor, force));
        low = std::min(low, force.x);
        high = std::max(high, force.x);
    }
    EXPECT_GT(high - low, 300);
    EXPECT_EQ(vibration_gain(100, 1000), 1);
    EXPECT_EQ(vibration_gain(450, 1000), 0);
    EXPECT_NEAR(vibration_gain(400, 1000), 0.5, 1e-12);
}

TEST(ForceTable, splits_where_the_cut_pauses_jumps_or_the_spindle_changes) {
    std::vector<ForceStretch> cut = swelling_cut(6000, 2, 40);
    for (std::size_t n = 10; n < 20; ++n) {
        cut[n].spectrum.harmonics[0].x = 900;  // jumps at 10 and back at 20
    }
    for (std::size_t n = 30; n < 40; ++n) cut[n].rate_rad_per_s *= 2;
    for (std::size_t n = 35; n < 40; ++n) {  // a pause of a second
        cut[n].start_s += 1;
        cut[n].end_s += 1;
    }
    const ForceTableOptions options;
    const ForceFunction function = force_function(cut, options);
    const ForceTable table = build_force_table(function, options);
    EXPECT_EQ(table.table().pieces().size(), 5U);
    EXPECT_EQ(table.pieces().size(), 5U);
    ForceTable::Cursor cursor;
    Vec3 force;
    EXPECT_FALSE(table.force_at(cut[34].end_s + 0.5, 1000, cursor, force));
    EXPECT_TRUE(table.force_at(cut[35].start_s + 0.001, 1000, cursor, force));
    EXPECT_LE(worst_error_jnd(table.table(), function.dense, force_error(options), 8), 0.5 * 1.001);
}

// Between two rows whose forces point apart the force passes near zero and turns about: no knots far apart
// may skip that.
TEST(ForceTable, stays_within_half_a_jnd_where_a_force_turns_about) {
    std::vector<ForceStretch> cut = swelling_cut(6000, 2, 200, 0.0);
    for (std::size_t n = 0; n < cut.size(); ++n) {
        const double way =
            3 * std::sin(0.9 * static_cast<double>(n));  // newtons at the tool, 0.03 at the hand
        cut[n].spectrum.harmonics[0].x = way;
        cut[n].spectrum.harmonics[0].y = 0.4 * std::cos(1.7 * static_cast<double>(n));
    }
    const ForceTableOptions options;
    const ForceFunction function = force_function(cut, options);
    const ForceTable table = build_force_table(function, options);
    EXPECT_LE(worst_error_jnd(table.table(), function.dense, force_error(options), 16), 0.5 * 1.05);
}

TEST(ForceTable, holds_nothing_where_nothing_was_cut) {
    const ForceTable table = build_force_table(force_function({}, {}), {});
    ForceTable::Cursor cursor;
    Vec3 force;
    EXPECT_FALSE(table.force_at(0, 1000, cursor, force));
    EXPECT_EQ(table.bytes(), 0U);
}

}  // namespace
}  // namespace tribo::contact
