// SPDX-License-Identifier: MIT
// What collocation in Gauss points needs (Hairer and Wanner, Solving ODEs II, IV.5).
#pragma once

#include <cstddef>
#include <vector>

namespace tribo::dynamics {

// On [0, 1].
struct GaussPoints {
    explicit GaussPoints(int count);

    // The shares of the points in the value at a place of the polynomial through them. `out`: as many.
    void shares(double at, double* out) const;

    std::vector<double> x, weight;  // ascending; the sum of the weights is 1
    // The integral from 0 to each point, and in the last row to 1, of the polynomial through values at the
    // points, and the integral of that integral: matrices by rows.
    std::vector<double> once, twice;

  private:
    std::vector<double> barycentric_;
};

// Solves a linear system. The first `count` columns of the matrix by rows, count x width, are the system; the
// right sides behind them become the solutions. Elimination with partial pivoting.
void eliminate(std::size_t count, std::size_t width, double* matrix);

}  // namespace tribo::dynamics
