// SPDX-License-Identifier: MIT
// A stock in words: `80 60 20` or `80x60x20` (a block of that size), `0 0 -20 80 60 0` (two corners),
// `blank.stl` (a model).
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"
#include "job/program_inputs.hpp"

namespace tribo::job {

// Lengths are in mm, or carry a unit (3in). A text that does not begin like a number, or ends like the name
// of a model, is a model file. Refuses other counts of numbers, and corners and edges out of range
// (base/limits.hpp).
Result<StockInput> parse_stock_words(std::string_view text);

// `x y z x y z`, which parse_stock_words() reads back to the same box.
std::string stock_words(const Box3& box_mm);

}  // namespace tribo::job
