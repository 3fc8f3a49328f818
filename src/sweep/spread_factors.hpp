// SPDX-License-Identifier: MIT
// An uncertain value in cases that are equally likely: a Latin hypercube.
#pragma once

#include <cstddef>
#include <vector>

namespace tribo::sweep {

// The factors of one value in all cases, always the same ones. They are lognormal, 9 of 10 within a band.
// Each of as many quantiles as there are cases is taken once, in an order of its own for each value (McKay,
// Beckman and Conover 1979).
class SpreadFactors {
  public:
    // 9 of 10 lie between `low` and `high`, both > 0. `value`: a number for each value that is off by itself;
    // cases of one number go together.
    SpreadFactors(std::size_t cases, std::size_t value, double low, double high);
    // Between 1 / (1 + spread) and 1 + spread.
    SpreadFactors(std::size_t cases, std::size_t value, double spread)
        : SpreadFactors(cases, value, 1 / (1 + spread), 1 + spread) {}

    double at(std::size_t n) const;

  private:
    double middle_, sigma_;
    std::vector<std::size_t> order_;
};

}  // namespace tribo::sweep
