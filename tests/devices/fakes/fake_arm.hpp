// SPDX-License-Identifier: MIT
// What a fake driver library does, set and looked at by the tests: both drivers export `fake_arm()`.
#pragma once

#include <atomic>
#include <mutex>
#include <string>

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
    std::atomic<bool> expert{false};     // dhd: the watchdog may be set
    std::atomic<int> watchdog_fires{0};  // dhd: so many of the next commands come too late
    std::atomic<int> force_off_cause{0};
    std::atomic<int> force_fails{0};  // dhd: so many of the next forces are not taken
    std::atomic<int> style{0};        // HD: of the last calibration
    std::atomic<int> styles{4};       // HD: that the arm knows
    std::atomic<int> stall_ms{0};     // HD's scheduler sleeps so long between ticks; 0: 1 ms

    // The calls in their order; one that is repeated at once is written once.
    void called(const char* name) {
        const std::lock_guard lock(mutex_);
        if (last_ == name) return;
        last_ = name;
        calls_ += (calls_.empty() ? "" : " ") + last_;
    }
    std::string calls() {
        const std::lock_guard lock(mutex_);
        return calls_;
    }
    void forget() {
        const std::lock_guard lock(mutex_);
        calls_.clear();
        last_.clear();
    }

  private:
    std::mutex mutex_;
    std::string calls_, last_;
};

}  // namespace tribo::test
