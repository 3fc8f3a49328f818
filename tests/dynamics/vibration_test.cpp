// SPDX-License-Identifier: MIT
// Vibration in time against the multipliers, against the force of a rigid tool, and in statics.
#include "dynamics/vibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "dynamics/benchmark_slot.hpp"
#include "dynamics/stability.hpp"
#include "dynamics/surface_by_angle.hpp"
#include "milling/force/force.hpp"

namespace tribo::dynamics {
namespace {

constexpr double kPi = math::kPi, kRateHz = 48'000;

milling::EngagementBand slot(double depth_mm) {
    return {0, depth_mm, 0, kPi};
}

// Growth per tooth of a vibration over forced ones. The feed grows from tooth to tooth by more than the
// vibration, so that no tooth leaves the cut: the linear equations hold for as long as one likes. What the
// feed forces grows by exactly its factor and drops out of d(t) = r(t) - factor r(t - T). The rest is a pair
// of multipliers mu, mu*: d(t + T) = 2 Re mu d(t) - |mu|^2 d(t - T), by least squares over some teeth.
double growth_per_tooth(double depth_mm, double rpm) {
    const Mode mode = benchmark_mode();
    const milling::EngagementBand band = slot(depth_mm);
    Vibration vibration({&mode, 1}, kCutter, kAluminium, kRateHz);
    const double per_tooth = kRateHz * 30 / rpm;  // samples
    const auto tooth = static_cast<std::size_t>(std::lround(per_tooth));
    EXPECT_NEAR(per_tooth, static_cast<double>(tooth), 1e-9);
    constexpr double kFactor = 1.6;
    constexpr std::size_t kTeeth = 40, kSettled = 22;
    double feed = 1e-3;
    std::vector<double> r;
    for (std::size_t n = 0; n < kTeeth; ++n, feed *= kFactor) {
        vibration.engage({&band, 1}, {.across_mm = feed}, rpm);
        for (std::size_t k = 0; k < tooth; ++k) r.push_back(vibration.step().displacement_mm.x);
    }
    std::vector<double> d(r.size());
    for (std::size_t n = tooth; n < r.size(); ++n) d[n] = r[n] - kFactor * r[n - tooth];
    double aa = 0, ab = 0, bb = 0, ay = 0, by = 0;
    for (std::size_t n = kSettled * tooth; n < r.size(); ++n) {
        const double weight = std::pow(1.2, -2.0 * static_cast<double>(n) / per_tooth);
        const double a = d[n - tooth], b = d[n - 2 * tooth], y = d[n];
        aa += weight * a * a;
        ab += weight * a * b;
        bb += weight * b * b;
        ay += weight * a * y;
        by += weight * b * y;
    }
    return std::sqrt(-(aa * by - ab * ay) / (aa * bb - ab * ab));
}

TEST(Vibration, grows_by_the_multiplier_from_tooth_to_tooth) {
    for (const double depth_mm : {0.2, 0.5, 0.7}) {
        const Mode mode = benchmark_mode();
        const milling::EngagementBand band = slot(depth_mm);
        const double known =
            stability({&mode, 1}, CutFeedback(kCutter, kAluminium, {&band, 1}, 5000)).multiplier;
        EXPECT_NEAR(growth_per_tooth(depth_mm, 5000) / known, 1, 1e-3) << depth_mm;
    }
}

// Greatest distance from the mean over the last of these teeth, mm.
double swing(double depth_mm, double rpm, double feed_mm, int teeth, int last) {
    const Mode mode = benchmark_mode();
    const milling::EngagementBand band = slot(depth_mm);
    Vibration vibration({&mode, 1}, kCutter, kAluminium, kRateHz);
    vibration.engage({&band, 1}, {.across_mm = feed_mm}, rpm);
    const int per_tooth = static_cast<int>(kRateHz * 30 / rpm);
    double low = 1e9, high = -1e9;
    for (int n = 0; n < teeth * per_tooth; ++n) {
        const double x = vibration.step().displacement_mm.x;
        if (n < (teeth - last) * per_tooth) continue;
        low = std::min(low, x);
        high = std::max(high, x);
    }
    return 0.5 * (high - low);
}

TEST(Vibration, of_chatter_is_bounded_by_teeth_that_leave_the_cut) {
    constexpr double kFeed = 0.1;
    const double after_100 = swing(1, 5000, kFeed, 100, 40), after_1000 = swing(1, 5000, kFeed, 1000, 40);
    EXPECT_GT(after_100, 0.5 * kFeed);
    EXPECT_LT(after_100, 5 * kFeed);
    EXPECT_NEAR(after_1000 / after_100, 1, 0.2);
    // A stable cut of the same depth swings as its forces do.
    EXPECT_LT(swing(1, 9000, kFeed, 1000, 40), 0.5 * kFeed);
    // The feed only scales it.
    EXPECT_NEAR(swing(1, 5000, 2 * kFeed, 100, 40) / after_100, 2, 1e-6);
}

// Another program for the same teeth: what grew is as large.
TEST(Vibration, of_chatter_is_as_large_as_computed_by_angle) {
    struct Case {
        std::vector<Mode> modes;
        double depth_mm, rpm, tolerance;
    };
    for (const auto& [modes, depth_mm, rpm, tolerance] :
         {Case{{benchmark_mode()}, 0.4, 5000, 0.01}, Case{{benchmark_mode()}, 1, 8000, 0.02},
          Case{{benchmark_mode()}, 1, 9000, 0.01},
          Case{{benchmark_mode(), {{0, 1, 0}, 1400, 0.03, 3000}}, 0.4, 8000, 0.02}}) {
        Vibration vibration(modes, kCutter, kAluminium, kRateHz);
        const milling::EngagementBand band = slot(depth_mm);
        constexpr double kFeed = 0.1;
        constexpr int kTeeth = 160, kLast = 40;
        vibration.engage({&band, 1}, {.across_mm = kFeed}, rpm);
        const int per_tooth = static_cast<int>(kRateHz * 30 / rpm);
        double largest = 0;
        for (int n = 0; n < kTeeth * per_tooth; ++n) {
            const Vec3 r = vibration.step().displacement_mm;
            if (n >= (kTeeth - kLast) * per_tooth) largest = std::max(largest, length(r));
        }
        const std::vector<double> swings =
            test::swings_by_angle(modes, kCutter, kAluminium, depth_mm, kFeed, rpm, kTeeth, 2000);
        const double expected = *std::max_element(swings.end() - kLast, swings.end());
        EXPECT_NEAR(largest / expected, 1, tolerance) << depth_mm << " mm, " << rpm << " rpm";
    }
}

struct Tool {
    milling::Cutter cutter;
    double tolerance;  // of the greatest force
};

class RigidTool : public testing::TestWithParam<Tool> {};

constexpr milling::CuttingCoefficients kSteel{1700, 600, 300, 15, 10, 5};

milling::Engagement two_bands() {
    milling::Engagement engagement;
    engagement.bands = {{0, 1.5, 0.3, 2.2}, {1.5, 6, 0.5, 2.6}};
    return engagement;
}

Vec3 turned(Vec3 v, double angle_rad) {
    const double sine = std::sin(angle_rad), cosine = std::cos(angle_rad);
    return {cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z};
}

// The greatest difference from the force of milling/force over two turns, of the greatest force. x of the
// feed is `feed_rad` from that of the vibration.
double off_rigid(Vibration& vibration, const milling::Cutter& cutter, const milling::ToolTravel& feed,
                 double feed_rad) {
    constexpr double kRpm = 6000;
    milling::ForceModel rigid(cutter, kSteel);
    rigid.engage(two_bands(), feed);
    vibration.engage(two_bands().bands, feed, kRpm, feed_rad);
    double largest = 0, worst = 0;
    for (int n = 0; n < 2 * kRateHz * 60 / kRpm; ++n) {
        const Vec3 expected = turned(rigid.at(vibration.rotation_rad() + feed_rad).force_n, feed_rad);
        largest = std::max(largest, length(expected));
        worst = std::max(worst, length(vibration.step().force_n - expected));
    }
    EXPECT_GT(largest, 100);
    return worst / largest;
}

// Modes a billion times as stiff: the force is that of milling/force.
TEST_P(RigidTool, cuts_as_one_that_does_not_bend) {
    const auto& [cutter, tolerance] = GetParam();
    std::array modes{benchmark_mode(), benchmark_mode({0.3, 1, 0.2})};
    for (Mode& mode : modes) mode.stiffness_n_per_mm *= 1e9;
    Vibration vibration(modes, cutter, kSteel, kRateHz);
    EXPECT_LT(off_rigid(vibration, cutter, {.across_mm = 0.08}, 0), tolerance);
}

// Without modes, on a path that goes down, with an axis that turns. The rigid model takes the arm of the
// turning and the slope of a round profile in the middles of its own slices.
TEST_P(RigidTool, cuts_in_any_direction_with_an_axis_that_turns) {
    const auto& [cutter, tolerance] = GetParam();
    Vibration straight({}, cutter, kSteel, kRateHz, -0.7);
    const double sloped = std::max(tolerance, cutter.corner_radius_mm() > 0 ? 2e-3 : 0);
    EXPECT_LT(off_rigid(straight, cutter, {.across_mm = 0.08, .down_mm = 0.01}, 0.7), sloped);
    Vibration turning({}, cutter, kSteel, kRateHz, 12.5);
    const milling::ToolTravel turn{
        .across_mm = 0.08, .down_mm = 0.01, .turn_x_rad = 1e-4, .turn_y_rad = -2e-4};
    EXPECT_LT(off_rigid(turning, cutter, turn, -2.1), std::max(sloped, 2e-3));
}

INSTANTIATE_TEST_SUITE_P(
    Cutters, RigidTool,
    testing::Values(
        Tool{{.diameter_mm = 12, .flutes = 3, .helix_deg = 0}, 1e-6},
        Tool{{.diameter_mm = 12, .flutes = 4, .helix_deg = 38}, 1e-6},
        Tool{{.diameter_mm = 12, .flutes = 2, .helix_deg = -30}, 1e-6},
        Tool{{.kind = milling::CutterKind::ball, .diameter_mm = 12, .flutes = 2, .helix_deg = 30}, 1e-6},
        Tool{{.kind = milling::CutterKind::bull, .diameter_mm = 12, .corner_mm = 2, .flutes = 4}, 1e-6},
        Tool{{.diameter_mm = 12, .flutes = 4, .helix_deg = 30, .pitch_deg = {84, 96, 84, 96}}, 1e-6},
        // The rigid model holds run-out over an eighth of a radian of lag.
        Tool{{.diameter_mm = 12, .flutes = 4, .helix_deg = 30, .runout_mm = 0.02, .runout_deg = 25}, 4e-3}));

TEST(Vibration, at_low_speed_is_force_over_stiffness) {
    const milling::Cutter cutter{.diameter_mm = 12, .flutes = 4, .helix_deg = 30};
    const milling::CuttingCoefficients k{1700, 600, 300, 15, 10, 5};
    const std::array modes{Mode{{1, 0, 0}, 3000, 0.3, 20'000}, Mode{{0, 1, 0}, 2500, 0.3, 15'000},
                           Mode{{0, 0, 1}, 4000, 0.3, 50'000, ModeOn::part}};
    Vibration vibration(modes, cutter, k, kRateHz);
    const milling::EngagementBand band{0, 3, 0.4, 2.2};
    vibration.engage({&band, 1}, {.across_mm = 0.05}, 20);
    const int per_turn = static_cast<int>(kRateHz) * 3;
    double largest = 0, worst = 0;
    for (int n = 0; n < 2 * per_turn; ++n) {
        const auto [r, f] = vibration.step();
        if (n < per_turn) continue;
        const Vec3 expected{f.x / 20'000, f.y / 15'000, f.z / 50'000};
        largest = std::max(largest, length(expected));
        worst = std::max(worst, length(r - expected));
    }
    EXPECT_GT(largest, 1e-3);
    EXPECT_LT(worst, 1e-3 * largest);
}

// The same mode on the tool and on the part is the same.
TEST(Vibration, knows_no_tool_and_no_part) {
    const milling::EngagementBand band = slot(0.8);
    Mode mode = benchmark_mode({1, 0.4, 0});
    Vibration of_tool({&mode, 1}, kCutter, kAluminium, kRateHz);
    mode.on = ModeOn::part;
    Vibration of_part({&mode, 1}, kCutter, kAluminium, kRateHz);
    of_tool.engage({&band, 1}, {.across_mm = 0.1}, 7000);
    of_part.engage({&band, 1}, {.across_mm = 0.1}, 7000);
    for (int n = 0; n < 10'000; ++n)
        ASSERT_EQ(of_tool.step().displacement_mm, of_part.step().displacement_mm);
}

// The same cut seen from a frame that is turned against it.
TEST(Vibration, is_the_same_in_a_turned_frame) {
    constexpr double kTurn = 0.9;
    const milling::EngagementBand band{0, 1, 0.2, 2.4};
    const std::array modes{Mode{{1, 0, 0}, 900, 0.02, 8000}, Mode{{0.2, 1, 0.3}, 1300, 0.03, 6000}};
    std::array by_frame = modes;
    for (Mode& mode : by_frame) mode.direction = turned(mode.direction, kTurn);
    Vibration straight(modes, kCutter, kAluminium, kRateHz);
    Vibration other(by_frame, kCutter, kAluminium, kRateHz, -kTurn);
    straight.engage({&band, 1}, {.across_mm = 0.1}, 7000);
    other.engage({&band, 1}, {.across_mm = 0.1}, 7000, kTurn);
    double largest = 0;
    for (int n = 0; n < 6000; ++n) {
        const Vec3 one = straight.step().displacement_mm, two = other.step().displacement_mm;
        largest = std::max(largest, length(one));
        ASSERT_LT(length(turned(one, kTurn) - two), 1e-9) << n;
    }
    EXPECT_GT(largest, 1e-3);
}

// A circle is as many short straight feeds as one likes: a rigid tool feels the chip of one feed per tooth
// across the direction in which it goes now, up to the turning of the feed from tooth to tooth.
TEST(Vibration, follows_a_feed_that_turns) {
    constexpr double kRpm = 6000, kFeed = 0.1, kTurnPerTooth = 2e-3;
    const milling::EngagementBand band{0, 1, 0, kPi};
    milling::ForceModel rigid(kCutter, kAluminium);
    milling::Engagement engagement;
    engagement.bands = {band};
    rigid.engage(engagement, {.across_mm = kFeed});
    Vibration vibration({}, kCutter, kAluminium, kRateHz);
    const double per_tooth = kRateHz * 60 / kRpm / kCutter.flutes;
    double largest = 0, worst = 0;
    for (int n = 0; n < 400 * per_tooth; ++n) {
        const double feed_rad = kTurnPerTooth * n / per_tooth;
        vibration.engage({&band, 1}, {.across_mm = kFeed}, kRpm, feed_rad);
        const Vec3 expected = turned(rigid.at(vibration.rotation_rad() + feed_rad).force_n, feed_rad);
        const Vec3 force = vibration.step().force_n;
        const double into_cut = std::fmod(vibration.rotation_rad() + feed_rad, kPi);
        if (into_cut < 0.05 || into_cut > kPi - 0.05) continue;  // entry and exit: the step that turned
        largest = std::max(largest, length(expected));
        worst = std::max(worst, length(force - expected));
    }
    EXPECT_GT(largest, 10);
    EXPECT_LT(worst / largest, 2 * kTurnPerTooth);
}

// In air nothing is felt, and what swings dies out at the rate of the modes.
TEST(Vibration, dies_out_in_air) {
    const Mode mode{{1, 0, 0}, 500, 0.02, 5000};
    Vibration vibration({&mode, 1}, kCutter, kAluminium, kRateHz);
    const milling::EngagementBand band = slot(2);
    vibration.engage({&band, 1}, {.across_mm = 0.1}, 6000);
    for (int n = 0; n < 5000; ++n) (void)vibration.step();
    vibration.engage({}, {.across_mm = 0.1}, 6000);
    std::vector<double> peaks;
    double before = 0, now = 0;
    for (int n = 0; n < 20'000; ++n) {
        const auto [r, f] = vibration.step();
        EXPECT_EQ(f, Vec3());
        if (n > 2 && now > before && now > r.x) peaks.push_back(now);
        before = now;
        now = r.x;
    }
    ASSERT_GT(peaks.size(), 150U);
    // Logarithmic decrement: 2 pi zeta / sqrt(1 - zeta^2).
    const double expected = 2 * kPi * 0.02 / std::sqrt(1 - 0.02 * 0.02);
    EXPECT_NEAR(std::log(peaks[5] / peaks[55]) / 50, expected, 1e-3 * expected);
}

// A slower spindle asks for more of the past than was kept: nothing jumps.
TEST(Vibration, goes_on_when_the_speed_changes) {
    const Mode mode = benchmark_mode();
    const milling::EngagementBand band = slot(0.3);
    Vibration vibration({&mode, 1}, kCutter, kAluminium, kRateHz);
    Vec3 before{};
    for (const double rpm : {9000.0, 4000.0, 12'000.0, 300.0, 20'000.0}) {
        vibration.engage({&band, 1}, {.across_mm = 0.1}, rpm);
        for (int n = 0; n < 3000; ++n) {
            const Vec3 r = vibration.step().displacement_mm;
            ASSERT_LT(length(r - before), 0.02) << rpm << " " << n;
            before = r;
        }
    }
}

}  // namespace
}  // namespace tribo::dynamics
