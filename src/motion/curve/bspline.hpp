// SPDX-License-Identifier: MIT
// B-spline curves over any vector space T, as in bezier.hpp. Everything except evaluation uses the blossom:
// the symmetric multi-affine form of a polynomial piece, whose values at consecutive knots are the control
// points. Any thread. Sources: Ramshaw 1989, CAGD 6 (blossoms); de Boor 1978; Boehm 1980 (knot insertion).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motion/curve/bezier.hpp"

namespace tribo::motion {

// knots: ascending, control.size() + degree + 1 of them, the first and the last degree + 1 times, every other
// at most degree times (so the curve has no jumps). At a knot of multiplicity m it is C^(degree - m).
template <class T>
struct BSpline {
    std::size_t degree = 1;
    std::vector<double> knots;
    std::vector<T> control;

    double start() const { return knots[degree]; }
    double end() const { return knots[control.size()]; }
};

template <class T>
bool is_valid(const BSpline<T>& s) {
    if (s.degree < 1 || s.degree > kMaxDegree || s.control.size() < s.degree + 1) return false;
    if (s.knots.size() != s.control.size() + s.degree + 1) return false;
    if (!std::is_sorted(s.knots.begin(), s.knots.end()) || !(s.start() < s.end())) return false;
    if (s.knots.front() != s.start() || s.knots.back() != s.end()) return false;
    for (std::size_t i = s.degree + 1; i + s.degree < s.control.size(); ++i)
        if (s.knots[i] == s.knots[i + s.degree]) return false;
    return true;
}

// Returns the k with knots[k] <= u < knots[k + 1], the last piece for u = end. A u outside is moved to the
// nearer end.
template <class T>
std::size_t find_span(const BSpline<T>& s, double u) {
    const auto first = s.knots.begin() + static_cast<std::ptrdiff_t>(s.degree);
    const auto last = s.knots.begin() + static_cast<std::ptrdiff_t>(s.control.size());
    const auto above = std::upper_bound(first, last, u);
    if (above == last) {
        // The last piece that has a length.
        std::size_t k = s.control.size() - 1;
        while (s.knots[k] == s.knots[k + 1]) --k;
        return k;
    }
    return static_cast<std::size_t>(std::max(above, first + 1) - s.knots.begin()) - 1;
}

// Returns the blossom of the piece over span k at `degree` arguments in any order. No allocation.
template <class T, std::size_t Room = kFewPoints>
T blossom(const BSpline<T>& s, std::size_t k, std::span<const double> arguments) {
    const std::size_t n = s.degree;
    assert(arguments.size() == n && s.knots[k] < s.knots[k + 1]);
    if constexpr (Room < kMaxDegree + 1)
        if (n >= Room) return blossom<T, kMaxDegree + 1>(s, k, arguments);
    std::array<T, Room> d{};
    for (std::size_t i = 0; i <= n; ++i) d[i] = s.control[k - n + i];
    for (std::size_t r = 1; r <= n; ++r)
        for (std::size_t i = n; i >= r; --i) {
            const double low = s.knots[k - n + i], high = s.knots[k + 1 + i - r];
            d[i] = mix(d[i - 1], d[i], (arguments[r - 1] - low) / (high - low));
        }
    return d[n];
}

// Returns the curve at u (de Boor). No allocation.
template <class T>
T evaluate(const BSpline<T>& s, double u) {
    std::array<double, kMaxDegree> same;
    same.fill(std::clamp(u, s.start(), s.end()));
    return blossom(s, find_span(s, u), std::span<const double>(same.data(), s.degree));
}

// One piece of a spline over start..end as a Bezier curve over 0..1.
template <class T>
struct BezierPiece {
    double start = 0, end = 1;
    std::vector<T> control;
};

// Returns the piece over span k, knots[k] < knots[k + 1].
template <class T>
BezierPiece<T> bezier_piece(const BSpline<T>& s, std::size_t k) {
    const double a = s.knots[k], b = s.knots[k + 1];
    BezierPiece<T> piece{a, b, {}};
    piece.control.reserve(s.degree + 1);
    std::array<double, kMaxDegree> arguments{};
    for (std::size_t j = 0; j <= s.degree; ++j) {
        for (std::size_t i = 0; i < s.degree; ++i) arguments[i] = i < s.degree - j ? a : b;
        piece.control.push_back(blossom(s, k, std::span<const double>(arguments.data(), s.degree)));
    }
    return piece;
}

// Returns the spline of degree n over `knots` whose pieces have the blossom form(k, n arguments), k a span of
// `knots`. The pieces must join as smoothly as the knots require.
template <class T, class Form>
BSpline<T> spline_of_blossom(std::size_t degree, std::vector<double> knots, Form form) {
    BSpline<T> r{degree, std::move(knots), {}};
    const std::size_t count = r.knots.size() - degree - 1;
    r.control.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        // Any piece that depends on the control point gives it. The longest one between its own knots (or
        // beside them, if they are all equal) extrapolates least.
        const bool one_knot = r.knots[i + 1] == r.knots[i + degree];
        const std::size_t first = one_knot ? i : i + 1, last = one_knot ? i + degree : i + degree - 1;
        std::size_t k = first;
        for (std::size_t j = first; j <= last; ++j)
            if (r.knots[j + 1] - r.knots[j] > r.knots[k + 1] - r.knots[k]) k = j;
        r.control.push_back(form(k, std::span<const double>(r.knots).subspan(i + 1, degree)));
    }
    return r;
}

// Raises the multiplicity of each distinct knot by `more`.
inline std::vector<double> with_multiplicity_raised(std::span<const double> knots, std::size_t more) {
    std::vector<double> raised;
    for (std::size_t i = 0; i < knots.size(); ++i) {
        raised.push_back(knots[i]);
        if (i + 1 == knots.size() || knots[i + 1] != knots[i]) raised.insert(raised.end(), more, knots[i]);
    }
    return raised;
}

// Returns multiply(a(u), b(u)) for a bilinear `multiply` and two splines of one degree n over the same knots:
// a spline of degree 2 n, as smooth as its factors. Its blossom is the mean over all ways to distribute the
// arguments to the factors (Morken 1991, Constr. Approx. 7).
template <class A, class B, class Multiply>
auto spline_product(const BSpline<A>& a, const BSpline<B>& b, Multiply multiply) {
    using T = decltype(multiply(a.control[0], b.control[0]));
    const std::size_t n = a.degree;
    assert(b.degree == n && a.knots == b.knots && 2 * n <= kMaxDegree);
    const std::vector<double> knots = with_multiplicity_raised(a.knots, n);
    return spline_of_blossom<T>(2 * n, knots, [&](std::size_t k, std::span<const double> arguments) {
        const std::size_t piece = find_span(a, knots[k]);
        T sum{};
        std::array<double, kMaxDegree> for_a{}, for_b{};
        for (std::uint32_t subset = 0; subset < (1u << (2 * n)); ++subset) {
            if (std::popcount(subset) != static_cast<int>(n)) continue;
            std::size_t i = 0, j = 0;
            for (std::size_t l = 0; l < 2 * n; ++l)
                (subset >> l & 1u ? for_a[i++] : for_b[j++]) = arguments[l];
            sum = sum + multiply(blossom(a, piece, std::span<const double>(for_a.data(), n)),
                                 blossom(b, piece, std::span<const double>(for_b.data(), n)));
        }
        return (1.0 / binomial(2 * n, n)) * sum;
    });
}

}  // namespace tribo::motion
