// SPDX-License-Identifier: MIT
// The Q parameters of a conversational program.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace tribo::readers::heidenhain {

inline constexpr int kParameters = 2000;  // Q0 to Q1999

class Parameters {
  public:
    static bool has(int index) { return index >= 0 && index < kParameters; }
    double get(int index) const { return values_[static_cast<std::size_t>(index)]; }
    void set(int index, double value) { values_[static_cast<std::size_t>(index)] = value; }

  private:
    std::array<double, kParameters> values_{};
};

}  // namespace tribo::readers::heidenhain
