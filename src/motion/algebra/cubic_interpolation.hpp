// SPDX-License-Identifier: MIT
// The C2 cubic spline through given values, over any vector space T. Any thread.
// Source: de Boor 1978, A Practical Guide to Splines, ch. IV and XIII.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "motion/algebra/banded.hpp"
#include "motion/curve/bspline.hpp"

namespace tribo::motion {

// natural: no second derivative at the ends, the least bending of all interpolants. not_a_knot: the first two
// pieces are one cubic, and so are the last two; fourth order up to the ends, but more overshoot with uneven
// spacing.
enum class EndCondition { natural, not_a_knot };

// Returns the cubic basis functions that are not zero at u, in span k: N(k - 3 .. k).
inline std::array<double, 4> cubic_basis(std::span<const double> knots, std::size_t k, double u) {
    std::array<double, 4> basis{1, 0, 0, 0};
    for (std::size_t d = 1; d <= 3; ++d)
        for (std::size_t i = d + 1; i-- > 0;) {
            // basis[i] becomes N(k - d + i) of degree d.
            const double left =
                i > 0 ? (u - knots[k - d + i]) / (knots[k + i] - knots[k - d + i]) * basis[i - 1] : 0;
            const double right =
                i < d ? (knots[k + i + 1] - u) / (knots[k + i + 1] - knots[k + i + 1 - d]) * basis[i] : 0;
            basis[i] = left + right;
        }
    return basis;
}

// Spreads the weights of n values over the control points of their interpolant: one each, the outer ones
// repeated.
inline std::vector<double> control_weights(std::span<const double> weights, std::size_t count) {
    const std::size_t lead = (count - weights.size()) / 2;
    std::vector<double> spread(count);
    for (std::size_t i = 0; i < count; ++i)
        spread[i] = weights[i < lead ? 0 : std::min(i - lead, weights.size() - 1)];
    return spread;
}

// u: strictly ascending, one per value, at least 2. Fewer than four values: natural ends. With weights > 0,
// one per value (none: all 1), the control points d_i are those of the rational spline sum w_i d_i N_i / sum
// w_i N_i with w = control_weights. It also keeps equal values equal and collinear values collinear. The end
// condition is applied to the d_i as if unweighted.
template <class T>
BSpline<T> interpolate_cubic(std::span<const double> u, std::span<const T> values, EndCondition ends,
                             std::span<const double> weights = {}) {
    assert(u.size() == values.size() && u.size() >= 2);
    const std::size_t n = u.size();
    const bool natural = ends == EndCondition::natural || n < 4;
    BSpline<T> s{3, std::vector<double>(3, u.front()), {}};
    for (std::size_t i = 0; i < n; ++i)
        if (natural || (i != 1 && i != n - 2)) s.knots.push_back(u[i]);
    s.knots.insert(s.knots.end(), 3, u.back());

    const std::size_t count = s.knots.size() - 4;
    s.control.resize(count);
    const std::vector<double> spread =
        weights.empty() ? std::vector<double>(count, 1.0) : control_weights(weights, count);
    BandedMatrix matrix(count, 2, 2);
    const auto set_value_row = [&](std::size_t row, std::size_t i) {
        const std::size_t k = find_span(s, u[i]);
        const std::array<double, 4> basis = cubic_basis(s.knots, k, u[i]);
        double sum = 0;
        for (std::size_t j = 0; j < 4; ++j) sum += spread[k - 3 + j] * basis[j];
        for (std::size_t j = 0; j < 4; ++j)
            if (basis[j] != 0) matrix.at(row, k - 3 + j) = spread[k - 3 + j] * basis[j] / sum;
        s.control[row] = values[i];
    };
    // A zero second derivative makes the divided differences of the first (last) three control points equal.
    const auto set_natural_row = [&](std::size_t row) {
        const double before = s.knots[row + 3] - s.knots[row], after = s.knots[row + 4] - s.knots[row + 1];
        matrix.at(row, row - 1) = -after / (before + after);
        matrix.at(row, row) = 1;
        matrix.at(row, row + 1) = -before / (before + after);
    };
    set_value_row(0, 0);
    set_value_row(count - 1, n - 1);
    if (natural) {
        set_natural_row(1);
        set_natural_row(count - 2);
    }
    for (std::size_t i = 1; i + 1 < n; ++i) set_value_row(natural ? i + 1 : i, i);
    const bool solved = matrix.solve(s.control);
    assert(solved);
    static_cast<void>(solved);
    return s;
}

}  // namespace tribo::motion
