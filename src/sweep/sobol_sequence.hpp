// SPDX-License-Identifier: MIT
// Sobol's sequence: points that fill the unit box evenly (Sobol' 1967), with the direction numbers of Joe and
// Kuo (2008). Any thread; no allocation.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tribo::sweep {

inline constexpr std::size_t kMostSobolDimensions = 40;

// Returns coordinate `dimension` of point `index`, in the middle of its cell of 2^-32, so that it is neither
// 0 nor 1. The points differ for all indices below 2^32; dimension < kMostSobolDimensions. `shift`: bits that
// are changed in the number of the cell, the same for all points (a digital shift, L'Ecuyer and Lemieux
// 2002): the points fill the box as evenly, and the first ones do not lie on its diagonals.
double sobol_coordinate(std::uint32_t index, std::size_t dimension, std::uint32_t shift = 0);

}  // namespace tribo::sweep
