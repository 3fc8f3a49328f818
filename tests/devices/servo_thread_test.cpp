// SPDX-License-Identifier: MIT
#include "devices/servo/servo_thread.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace tribo::devices {
namespace {

TEST(ServoThread, ticks_at_multiples_of_its_period_and_stops_when_told) {
    std::vector<double> times;
    times.reserve(300);
    ServoThread thread({1000, false, false}, [&](double now_s) {
        times.push_back(now_s);
        return times.size() < 200;
    });
    thread.join();
    ASSERT_EQ(times.size(), 200U);
    EXPECT_EQ(thread.clock().wall().count(), 200U);
    EXPECT_EQ(thread.lateness().count(), 200U);
    for (std::size_t n = 1; n < times.size(); ++n) EXPECT_GT(times[n], times[n - 1]);
    // As many deadlines as there were ticks and skips: none is made up for.
    EXPECT_GE(times.back(), 0.199 + 1e-3 * static_cast<double>(thread.skipped()) - 1e-6);
    EXPECT_FALSE(thread.problems().real_time.empty());
}

TEST(ServoThread, skips_what_it_missed_instead_of_hurrying) {
    int ticks = 0;
    ServoThread thread({1000, false, false}, [&](double) {
        if (++ticks == 5) std::this_thread::sleep_for(std::chrono::milliseconds(30));
        return ticks < 10;
    });
    thread.join();
    EXPECT_GE(thread.late(), 1U);
    EXPECT_GE(thread.skipped(), 28U);
}

TEST(ServoThread, can_be_stopped_from_outside) {
    ServoThread thread({1000, false, false}, [](double) { return true; });
    EXPECT_TRUE(thread.running());
    thread.stop();
    thread.join();
    EXPECT_FALSE(thread.running());
}

}  // namespace
}  // namespace tribo::devices
