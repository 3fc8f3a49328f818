// SPDX-License-Identifier: MIT
// Bezier curves over any vector space T (T + T, double * T, T{} = 0): numbers, points, quaternions, dual
// quaternions. Control points are a span of degree + 1; the parameter runs from 0 to 1. Any thread.
// Source: Farin 2002, Curves and Surfaces for CAGD, 5th ed., ch. 4-6.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace tribo::motion {

// Largest degree of a curve of this room: a motion of degree 6 has point paths of degree 12.
inline constexpr std::size_t kMaxDegree = 24;

// n over k, exact for n <= 2 kMaxDegree.
constexpr double binomial(std::size_t n, std::size_t k) {
    double b = 1;
    for (std::size_t i = 1; i <= k; ++i) b = b * static_cast<double>(n - k + i) / static_cast<double>(i);
    return b;
}

template <class T>
T mix(const T& a, const T& b, double t) {
    return (1 - t) * a + t * b;
}

// Usual largest number of points. Buffers of this size are cheaper to set up than those for kMaxDegree.
inline constexpr std::size_t kFewPoints = 8;

// Returns the value of the curve at t (de Casteljau). No allocation.
template <class T, std::size_t Room = kFewPoints>
T de_casteljau(std::span<const T> control, double t) {
    assert(!control.empty() && control.size() <= kMaxDegree + 1);
    if constexpr (Room < kMaxDegree + 1)
        if (control.size() > Room) return de_casteljau<T, kMaxDegree + 1>(control, t);
    std::array<T, Room> b{};
    std::copy(control.begin(), control.end(), b.begin());
    for (std::size_t n = control.size() - 1; n > 0; --n)
        for (std::size_t i = 0; i < n; ++i) b[i] = mix(b[i], b[i + 1], t);
    return b[0];
}
template <class T>
T de_casteljau(const std::vector<T>& control, double t) {
    return de_casteljau(std::span<const T>(control), t);
}

// Divides the curve into the part up to t and the part after t, each over 0..1.
template <class T>
std::pair<std::vector<T>, std::vector<T>> subdivide(std::span<const T> control, double t) {
    std::vector<T> left(control.size()), right(control.begin(), control.end());
    const std::size_t n = control.size() - 1;
    for (std::size_t r = 0; r <= n; ++r) {
        left[r] = right[0];
        for (std::size_t i = 0; i + r < n; ++i) right[i] = mix(right[i], right[i + 1], t);
    }
    return {std::move(left), std::move(right)};
}
template <class T>
std::pair<std::vector<T>, std::vector<T>> subdivide(const std::vector<T>& control, double t) {
    return subdivide(std::span<const T>(control), t);
}

// Returns the derivative by the parameter, one degree lower (degree 0 for a point).
template <class T>
std::vector<T> derivative(std::span<const T> control) {
    const std::size_t n = control.size() - 1;
    if (n == 0) return {T{}};
    std::vector<T> slope(n);
    for (std::size_t i = 0; i < n; ++i)
        slope[i] = static_cast<double>(n) * (control[i + 1] + (-1.0) * control[i]);
    return slope;
}
template <class T>
std::vector<T> derivative(const std::vector<T>& control) {
    return derivative(std::span<const T>(control));
}

// Returns multiply(a(t), b(t)) as a curve of the summed degree, for any bilinear `multiply`.
template <class A, class B, class Multiply>
auto bezier_product(std::span<const A> a, std::span<const B> b, Multiply multiply) {
    using T = decltype(multiply(a[0], b[0]));
    const std::size_t m = a.size() - 1, n = b.size() - 1;
    std::vector<T> c(m + n + 1);
    for (std::size_t i = 0; i <= m; ++i)
        for (std::size_t j = 0; j <= n; ++j)
            c[i + j] =
                c[i + j] + (binomial(m, i) * binomial(n, j) / binomial(m + n, i + j)) * multiply(a[i], b[j]);
    return c;
}

}  // namespace tribo::motion
