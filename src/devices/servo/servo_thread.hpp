// SPDX-License-Identifier: MIT
// Thread of the servo: absolute deadlines; real-time class and locked memory if the system allows them.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "devices/servo/tick_clock.hpp"

namespace tribo::devices {

struct ServoThreadOptions {
    double rate_hz = 1000;    // 100 to 20,000
    bool real_time = true;    // ask for SCHED_FIFO
    bool lock_memory = true;  // ask for mlockall
};

// Why the system refused real-time class or locked memory, with a remedy. Empty: granted.
struct RealTimeProblems {
    std::string real_time, memory;
};

// Calls `tick(now_s)` at k / rate_hz seconds from the start, k = 0, 1, ..., until it returns false or stop().
// Missed deadlines are skipped: the next tick is at the next multiple of the period. So a stall never causes
// a burst of ticks. The tick must not throw.
class ServoThread {
  public:
    using Tick = std::function<bool(double now_s)>;

    ServoThread(const ServoThreadOptions& options, Tick tick);
    // Calls stop() and join().
    ~ServoThread();
    ServoThread(const ServoThread&) = delete;
    ServoThread& operator=(const ServoThread&) = delete;

    void stop() { stop_.store(true, std::memory_order_relaxed); }
    // Waits for the end of the last tick.
    void join();
    bool running() const { return running_.load(std::memory_order_acquire); }

    // State of the running thread. References are valid until this object is destroyed.
    const RealTimeProblems& problems() const { return problems_; }
    const TickClock& clock() const { return *clock_; }
    // Delay of each tick after its deadline.
    const DurationHistogram& lateness() const { return lateness_; }
    // Number of ticks that ended after the next deadline; number of skipped deadlines.
    std::uint64_t late() const { return late_.load(std::memory_order_relaxed); }
    std::uint64_t skipped() const { return skipped_.load(std::memory_order_relaxed); }

  private:
    void run();
    void request_real_time();

    ServoThreadOptions options_;
    Tick tick_;
    std::unique_ptr<TickClock> clock_;
    DurationHistogram lateness_;
    RealTimeProblems problems_;
    std::atomic<bool> stop_{false}, running_{true};
    std::atomic<std::uint64_t> late_{0}, skipped_{0};
    std::atomic<bool> ready_{false};
    std::thread thread_;
};

}  // namespace tribo::devices
