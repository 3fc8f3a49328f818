// SPDX-License-Identifier: MIT
// The cases of a sweep: axes, a design, and the values of any case by its number. Any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sweep/distribution.hpp"

namespace tribo::sweep {

using Value = std::variant<double, std::string, bool>;

// An input that differs between the cases: either a list of values, or a distribution.
struct Axis {
    std::string key;  // dotted, as in "process.spindle_rpm"
    std::vector<Value> values{};
    std::optional<Distribution> distribution{};
};

// grid: every combination of the values; the last axis changes first.
// sobol: points of Sobol's sequence. With k axes, each point has a block of k + 2 cases: A, B, and for each
// axis A with that axis from B (Saltelli et al. 2010). Values of a list are equally likely.
enum class Design : std::uint8_t { grid, sobol };

struct Plan {
    std::vector<Axis> axes;
    Design design = Design::grid;
    std::uint64_t points = 0;  // sobol only; below 2^32

    // Number of cases. A grid of more than 2^63 gives 2^63.
    std::uint64_t cases() const;
    // Cases that belong together: k + 2 for sobol, else 1.
    std::uint64_t block() const { return design == Design::sobol ? axes.size() + 2 : 1; }
    // The values of the axes in this case, in their order.
    std::vector<Value> values(std::uint64_t number) const;
};

}  // namespace tribo::sweep
