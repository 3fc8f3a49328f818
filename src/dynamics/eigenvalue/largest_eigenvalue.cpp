// SPDX-License-Identifier: MIT
#include "dynamics/eigenvalue/largest_eigenvalue.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math.hpp"
#include "dynamics/eigenvalue/hessenberg.hpp"
#include "dynamics/step/tool_place.hpp"

namespace tribo::dynamics {
namespace {

using Complex = std::complex<double>;

// In four partial sums: one after the other they would wait for each other.
double dot(const double* a, const double* b, std::size_t size) {
    D2 even{}, odd{};
    std::size_t n = 0;
    for (; n + 4 <= size; n += 4) {
        even += D2{a[n], a[n + 1]} * D2{b[n], b[n + 1]};
        odd += D2{a[n + 2], a[n + 3]} * D2{b[n + 2], b[n + 3]};
    }
    even += odd;
    double sum = even[0] + even[1];
    for (; n < size; ++n) sum += a[n] * b[n];
    return sum;
}

double length(const double* v, std::size_t size) {
    return std::sqrt(dot(v, v, size));
}

// Not std::norm and std::abs: they differ between systems.
double squared(Complex v) {
    return v.real() * v.real() + v.imag() * v.imag();
}

// The eigenvector, of length 1, of a Hessenberg matrix whose lower diagonal has no zero: with 1 as its last
// number the rows give the others from below (Hyman).
std::vector<Complex> eigenvector(const std::vector<double>& h, std::size_t count, Complex value) {
    std::vector<Complex> v(count);
    v[count - 1] = 1;
    double sum_of_squares = 1;
    for (std::size_t row = count - 1; row > 0; --row) {
        Complex sum = value * v[row];
        for (std::size_t k = row; k < count; ++k) sum -= h[row * count + k] * v[k];
        v[row - 1] = sum / h[row * count + row - 1];
        sum_of_squares += squared(v[row - 1]);
    }
    for (Complex& x : v) x /= std::sqrt(sum_of_squares);
    return v;
}

}  // namespace

Eigenpair largest_eigenvalue(std::size_t size, std::size_t inputs,
                             const std::function<void(const double* from, double* to)>& map) {
    constexpr double kResidual = 1e-10;
    constexpr int kImages = 6;         // until the first vector of the space: small eigenvalues die out
    constexpr std::size_t kFirst = 7;  // vectors of the space, at which it is looked at first
    std::vector<double> start(size), image(size);
    for (std::size_t n = 0; n < inputs; ++n) start[size - inputs + n] = math::cos(static_cast<double>(n));
    for (int n = 0; n < kImages; ++n) {
        map(start.data(), image.data());
        std::swap(start, image);
        const double norm = length(start.data(), size);
        if (norm == 0) return {};
        for (double& x : start) x /= norm;
    }
    std::vector<double> space(start);  // orthonormal vectors of `size` numbers
    const double norm = length(space.data(), size);
    for (double& x : space) x /= norm;
    space.reserve(2 * kFirst * size);
    std::vector<double> columns;  // of the map in that space, one longer each
    std::size_t next = kFirst;
    for (std::size_t count = 1;; ++count) {
        map(&space[(count - 1) * size], image.data());
        const double before = length(image.data(), size);
        const std::size_t column = columns.size();
        columns.resize(column + count + 1);
        // Twice: the first time leaves roundoff of what it takes away.
        for (int pass = 0; pass < 2; ++pass) {
            for (std::size_t k = 0; k < count; ++k) {
                const double* v = &space[k * size];
                const double share = dot(v, image.data(), size);
                for (std::size_t n = 0; n < size; ++n) image[n] -= share * v[n];
                columns[column + k] += share;
            }
        }
        const double left = length(image.data(), size);
        columns[column + count] = left;
        constexpr double kNothing = 1e-14;
        const bool whole = left <= kNothing * before || count == size;
        if (whole || count == next) {
            std::vector<double> h(count * count);
            std::size_t at = 0;
            for (std::size_t c = 0; c < count; ++c) {
                for (std::size_t r = 0; r <= c + 1; ++r, ++at)
                    if (r < count) h[r * count + c] = columns[at];
            }
            Complex largest = 0;
            for (const Complex& value : hessenberg_eigenvalues(h, count))
                if (squared(value) > squared(largest)) largest = value;
            const std::vector<Complex> shares = eigenvector(h, count, largest);
            const double share = std::sqrt(squared(shares.back()));
            if (whole || left * share <= kResidual * std::sqrt(squared(largest))) {
                Eigenpair found{largest, std::vector<Complex>(size)};
                for (std::size_t k = 0; k < count; ++k)
                    for (std::size_t n = 0; n < size; ++n) found.vector[n] += space[k * size + n] * shares[k];
                return found;
            }
            next += next / 2;
        }
        for (const double x : image) space.push_back(x / left);
    }
}

}  // namespace tribo::dynamics
