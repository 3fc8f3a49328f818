// SPDX-License-Identifier: MIT
#include "devices/servo/servo_thread.hpp"

#include <cerrno>
#include <cstring>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <time.h>

namespace tribo::devices {
namespace {

// Below the threads of the kernel (50 and up by default), above ordinary threads.
constexpr int kPriority = 40;
// Part of the stack that is touched in advance, so that no tick causes a page fault.
constexpr std::size_t kStackBytes = 128 * 1024;

[[gnu::noinline]] void touch_stack() {
    char stack[kStackBytes];
    std::memset(stack, 1, sizeof stack);
    asm volatile("" : : "r"(stack) : "memory");
}

void sleep_until(std::uint64_t ns) noexcept {
    const timespec until{static_cast<time_t>(ns / 1'000'000'000), static_cast<long>(ns % 1'000'000'000)};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
}

}  // namespace

ServoThread::ServoThread(const ServoThreadOptions& options, Tick tick)
    : options_(options), tick_(std::move(tick)), thread_([this] { run(); }) {
    ready_.wait(false, std::memory_order_acquire);
}

ServoThread::~ServoThread() {
    stop();
    join();
}

void ServoThread::join() {
    if (thread_.joinable()) thread_.join();
}

void ServoThread::request_real_time() {
    if (options_.real_time) {
        const sched_param priority{kPriority};
        const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
        if (error != 0) {
            problems_.real_time =
                std::string("no real-time class (") + std::strerror(error) +
                "): other programs may hold a tick up by milliseconds; allow it with a line '@realtime "
                "- rtprio 50' in /etc/security/limits.d/ and yourself in that group";
        }
    } else {
        problems_.real_time = "no real-time class was asked for";
    }
    if (options_.lock_memory && mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
        problems_.memory =
            std::string("memory is not locked (") + std::strerror(errno) +
            "): a tick may wait for a page; allow it with a line '@realtime - memlock unlimited' in "
            "/etc/security/limits.d/";
    }
    touch_stack();
}

void ServoThread::run() {
    request_real_time();
    clock_ = std::make_unique<TickClock>();
    ready_.store(true, std::memory_order_release);
    ready_.notify_all();
    const auto period = static_cast<std::uint64_t>(1e9 / options_.rate_hz + 0.5);
    const std::uint64_t start = wall_ns();
    std::uint64_t next = 0;  // next tick, counted in periods
    bool more = true;
    while (more && !stop_.load(std::memory_order_relaxed)) {
        const std::uint64_t deadline = start + next * period;
        sleep_until(deadline);
        const std::uint64_t now = wall_ns();
        lateness_.record(now > deadline ? now - deadline : 0);
        clock_->begin();
        more = tick_(static_cast<double>(now - start) * 1e-9);
        clock_->end();
        const std::uint64_t due = (wall_ns() - start) / period + 1;  // the first deadline in the future
        if (due > next + 1) {
            late_.fetch_add(1, std::memory_order_relaxed);
            skipped_.fetch_add(due - next - 1, std::memory_order_relaxed);
        }
        next = due > next ? due : next + 1;
    }
    running_.store(false, std::memory_order_release);
}

}  // namespace tribo::devices
