// SPDX-License-Identifier: MIT
#include "sweep/plan.hpp"

#include <algorithm>
#include <cassert>

#include "base/noise_hash.hpp"
#include "sweep/sobol_sequence.hpp"

namespace tribo::sweep {
namespace {

constexpr std::uint64_t kMostCases = std::uint64_t{1} << 63;

// Any bits, always the same ones.
std::uint32_t shift_of(std::size_t dimension) {
    return static_cast<std::uint32_t>(CounterNoise(0x7377656570).bits(dimension));
}

Value value_at(const Axis& axis, double below) {
    if (axis.distribution) return quantile(*axis.distribution, below);
    const auto count = static_cast<double>(axis.values.size());
    return axis.values[std::min(static_cast<std::size_t>(below * count), axis.values.size() - 1)];
}

}  // namespace

std::uint64_t Plan::cases() const {
    if (design == Design::sobol) return points * block();
    std::uint64_t count = 1;
    for (const Axis& axis : axes) {
        if (axis.values.empty()) return 0;
        if (count > kMostCases / axis.values.size()) return kMostCases;
        count *= axis.values.size();
    }
    return count;
}

std::vector<Value> Plan::values(std::uint64_t number) const {
    assert(number < cases());
    std::vector<Value> values(axes.size());
    if (design == Design::grid) {
        for (std::size_t n = axes.size(); n-- > 0;) {
            const std::uint64_t count = axes[n].values.size();
            values[n] = axes[n].values[static_cast<std::size_t>(number % count)];
            number /= count;
        }
        return values;
    }
    const auto point = static_cast<std::uint32_t>(number / block());
    const std::uint64_t place = number % block();  // 0: A, 1: B, n + 2: A with axis n from B
    for (std::size_t n = 0; n < axes.size(); ++n) {
        const bool is_b = place == 1 || place == n + 2;
        const std::size_t dimension = is_b ? axes.size() + n : n;
        values[n] = value_at(axes[n], sobol_coordinate(point, dimension, shift_of(dimension)));
    }
    return values;
}

}  // namespace tribo::sweep
