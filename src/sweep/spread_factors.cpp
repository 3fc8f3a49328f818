// SPDX-License-Identifier: MIT
#include "sweep/spread_factors.hpp"

#include <algorithm>
#include <cassert>

#include "base/math.hpp"
#include "base/noise_hash.hpp"
#include "sweep/distribution.hpp"

namespace tribo::sweep {
namespace {

constexpr double kRangeSigmas = 1.6448536;  // standard deviations
constexpr std::uint64_t kOrders = 0x63686174746572;

}  // namespace

SpreadFactors::SpreadFactors(std::size_t cases, std::size_t value, double low, double high)
    : middle_(0.5 * (math::log(low) + math::log(high))),
      sigma_(0.5 * (math::log(high) - math::log(low)) / kRangeSigmas),
      order_(cases) {
    assert(cases > 0 && low > 0 && low <= high);
    // The quantiles in an order of their own.
    const CounterNoise noise(kOrders + value);
    for (std::size_t n = 0; n < cases; ++n) order_[n] = n;
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
        return noise.bits(a) != noise.bits(b) ? noise.bits(a) < noise.bits(b) : a < b;
    });
}

double SpreadFactors::at(std::size_t n) const {
    const double below = (static_cast<double>(order_[n]) + 0.5) / static_cast<double>(order_.size());
    return math::exp(middle_ + sigma_ * normal_quantile(below));
}

}  // namespace tribo::sweep
