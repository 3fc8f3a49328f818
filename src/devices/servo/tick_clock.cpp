// SPDX-License-Identifier: MIT
#include "devices/servo/tick_clock.hpp"

#include <time.h>

namespace tribo::devices {
namespace {

constexpr int kEmptySections = 20'000;

std::uint64_t read(clockid_t clock) noexcept {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<std::uint64_t>(t.tv_sec) * 1'000'000'000 + static_cast<std::uint64_t>(t.tv_nsec);
}

std::uint64_t less(std::uint64_t a, std::uint64_t b) noexcept {
    return a > b ? a - b : 0;
}

}  // namespace

std::uint64_t wall_ns() noexcept {
    return read(CLOCK_MONOTONIC);
}
std::uint64_t thread_cpu_ns() noexcept {
    return read(CLOCK_THREAD_CPUTIME_ID);
}

TickClock::TickClock() {
    for (int n = 0; n < kEmptySections; ++n) {
        begin();
        const std::uint64_t wall = wall_ns(), cpu = thread_cpu_ns();
        empty_wall_.record(less(wall, wall_start_));
        empty_cpu_.record(less(cpu, cpu_start_));
    }
    wall_cost_ = empty_wall_.quantile_ns(0.5);
    cpu_cost_ = empty_cpu_.quantile_ns(0.5);
}

void TickClock::end() noexcept {
    const std::uint64_t wall = wall_ns(), cpu = thread_cpu_ns();
    wall_.record(less(less(wall, wall_start_), wall_cost_));
    cpu_.record(less(less(cpu, cpu_start_), cpu_cost_));
}

}  // namespace tribo::devices
