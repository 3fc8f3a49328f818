// SPDX-License-Identifier: MIT
// A thread of its own for the servo: absolute deadlines, the real-time class and locked memory where the
// system allows them.
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

// What the system granted, in words that say what to do where it did not. Empty: granted.
struct Granted {
    std::string real_time, memory;
};

// Calls `tick(now_s)` at k / rate_hz seconds from the start, k = 0, 1, ..., until it gives false or stop().
// Overruns: a tick whose time has passed is not made up for; the next one happens at the next multiple of the
// period, so that a stall never becomes a burst. The tick must not throw.
class ServoThread {
  public:
    using Tick = std::function<bool(double now_s)>;

    ServoThread(const ServoThreadOptions& options, Tick tick);
    // Stops and waits.
    ~ServoThread();
    ServoThread(const ServoThread&) = delete;
    ServoThread& operator=(const ServoThread&) = delete;

    void stop() { stop_.store(true, std::memory_order_relaxed); }
    // Waits until the last tick is over.
    void join();
    bool running() const { return running_.load(std::memory_order_acquire); }

    // Of the thread, once it runs; valid until this object goes.
    const Granted& granted() const { return granted_; }
    const TickClock& clock() const { return *clock_; }
    // How long after its deadline each tick began.
    const DurationHistogram& lateness() const { return lateness_; }
    // Ticks that ended after the next one's deadline, and deadlines that so went by without a tick.
    std::uint64_t late() const { return late_.load(std::memory_order_relaxed); }
    std::uint64_t skipped() const { return skipped_.load(std::memory_order_relaxed); }

  private:
    void run();
    void ask_the_system();

    ServoThreadOptions options_;
    Tick tick_;
    std::unique_ptr<TickClock> clock_;
    DurationHistogram lateness_;
    Granted granted_;
    std::atomic<bool> stop_{false}, running_{true};
    std::atomic<std::uint64_t> late_{0}, skipped_{0};
    std::atomic<bool> ready_{false};
    std::thread thread_;
};

}  // namespace tribo::devices
