// SPDX-License-Identifier: MIT
#include "noise/play/finger_motion.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>

namespace tribo::noise {
namespace {

// A finger whose speed swings about 200 mm/s, reported at `rate`; the lag of the estimate by the phase of the
// swing.
double lag_s(double swing_hz, double rate) {
    FingerMotion finger;
    const double w = 2 * std::numbers::pi * swing_hz;
    const auto place = [&](double t) { return 200 * t - 100 / w * (std::cos(w * t) - 1); };
    std::complex<double> truth = 0, found = 0;
    double next_report = 0;
    for (double t = 0; t < 10; t += 0.0005) {
        if (t >= next_report) {
            finger.touch(t, place(t), 0, 1);
            next_report += 1 / rate;
        }
        if (t < 1) continue;
        const auto turn = std::polar(1.0, -w * t);
        truth += (200 + 100 * std::sin(w * t)) * turn;
        found += finger.at(t).speed_mm_per_s * turn;
    }
    return -std::arg(found / truth) / w;
}

TEST(FingerMotion, lags_by_12_ms_at_most_at_60_reports_a_second) {
    for (const double swing : {0.5, 1.0, 2.0, 4.0}) {
        EXPECT_LT(lag_s(swing, 60), 0.012) << swing;
        EXPECT_GT(lag_s(swing, 60), -0.002) << swing;
        EXPECT_LT(lag_s(swing, 120), 0.006) << swing;
    }
}

TEST(FingerMotion, tells_a_steady_speed_exactly_and_without_ripple) {
    FingerMotion finger;
    double next_report = 0;
    for (double t = 0; t < 1; t += 0.0005) {
        if (t >= next_report) {
            finger.touch(t, 90 * t, 120 * t, 0.7);
            next_report += 1.0 / 60;
        }
        if (t < 0.2) continue;
        EXPECT_NEAR(finger.at(t).speed_mm_per_s, 150, 0.5);
        EXPECT_EQ(finger.at(t).force_n, 0.7);
    }
}

TEST(FingerMotion, starts_with_the_second_report_and_jumps_nowhere_later) {
    FingerMotion finger;
    finger.touch(0, 0, 0, 1);
    EXPECT_EQ(finger.at(0.01).speed_mm_per_s, 0);
    finger.touch(1.0 / 60, 2, 0, 1);
    EXPECT_NEAR(finger.at(1.0 / 60).speed_mm_per_s, 120, 1e-9);
    finger.touch(2.0 / 60, 5, 0, 1);
    const double before = 120;
    EXPECT_NEAR(finger.at(2.0 / 60).speed_mm_per_s, before, 1);
    EXPECT_GT(finger.at(2.0 / 60 + 0.008).speed_mm_per_s, 175);
}

TEST(FingerMotion, of_a_finger_that_stays_or_leaves_ends) {
    FingerMotion finger;
    for (int n = 0; n < 10; ++n) finger.touch(n / 60.0, 2.0 * n, 0, 1);
    EXPECT_NEAR(finger.at(9 / 60.0 + 0.02).speed_mm_per_s, 120, 1);
    EXPECT_LT(finger.at(9 / 60.0 + 0.1).speed_mm_per_s, 1);
    EXPECT_EQ(finger.at(9 / 60.0 + 1).speed_mm_per_s, 0);
    EXPECT_EQ(finger.at(9 / 60.0 + 1).force_n, 1);
    finger.lift();
    EXPECT_EQ(finger.at(2).force_n, 0);
    // Moving on after a rest: the way was made in the last intervals, not in the whole rest.
    finger.touch(3, 0, 0, 1);
    finger.touch(4, 2, 0, 1);
    EXPECT_GT(finger.at(4).speed_mm_per_s, 50);
}

TEST(FingerMotion, takes_reports_at_one_time_for_one) {
    FingerMotion finger;
    finger.touch(0, 0, 0, 1);
    finger.touch(0.0001, 50, 0, 1);
    finger.touch(1.0 / 60, 2, 0, 1);
    EXPECT_NEAR(finger.at(1.0 / 60).speed_mm_per_s, 120, 1);
}

}  // namespace
}  // namespace tribo::noise
