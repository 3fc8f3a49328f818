// SPDX-License-Identifier: MIT
// What a fake driver library does, set and looked at by the tests: both drivers export `fake_arm()`.
#pragma once

#include <atomic>

namespace tribo::test {

struct FakeArm {
    std::atomic<double> position[3] = {0, 0, 0};  // in the driver's own axes and unit
    std::atomic<double> velocity[3] = {0, 0, 0};
    std::atomic<double> force[3] = {0, 0, 0};  // the last one that was set
    std::atomic<int> buttons{0};
    std::atomic<int> error{0};        // the driver's own code for every call from now on
    std::atomic<bool> plugged{true};  // when it is opened
    std::atomic<int> calibration{0};  // HD: 0 ok, 1 needs update, 2 needs hands
    std::atomic<bool> calibrated{false};
    std::atomic<int> version{3};
    std::atomic<bool> forces_on{false};
    std::atomic<int> watchdog{0};
    std::atomic<bool> open{false};
    std::atomic<int> stall_ms{0};  // HD's scheduler sleeps so long between ticks; 0: 1 ms
};

}  // namespace tribo::test
