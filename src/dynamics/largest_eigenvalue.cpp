// SPDX-License-Identifier: MIT
#include "dynamics/largest_eigenvalue.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math.hpp"
#include "dynamics/tool_place.hpp"

namespace tribo::dynamics {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;

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

// The share of the last basis vector in the eigenvector of a Hessenberg matrix whose lower diagonal has no
// zero: with 1 as its last number the rows give the others from below (Hyman).
double last_share(const MatrixXd& h, Complex value) {
    const Eigen::Index count = h.rows();
    Eigen::VectorXcd v(count);
    v[count - 1] = 1;
    for (Eigen::Index row = count - 1; row > 0; --row) {
        Complex sum = value * v[row];
        for (Eigen::Index k = row; k < count; ++k) sum -= h(row, k) * v[k];
        v[row - 1] = sum / h(row, row - 1);
    }
    return 1 / v.norm();
}

}  // namespace

Complex largest_eigenvalue(std::size_t size, std::size_t inputs,
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
        if (norm == 0) return 0;
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
            const auto n = static_cast<Eigen::Index>(count);
            MatrixXd h = MatrixXd::Zero(n, n);
            std::size_t at = 0;
            for (Eigen::Index c = 0; c < n; ++c) {
                for (Eigen::Index r = 0; r <= c + 1; ++r, ++at)
                    if (r < n) h(r, c) = columns[at];
            }
            Complex largest = 0;
            for (const Complex& value : h.eigenvalues())
                if (std::abs(value) > std::abs(largest)) largest = value;
            if (whole || left * last_share(h, largest) <= kResidual * std::abs(largest)) return largest;
            next += next / 2;
        }
        for (const double x : image) space.push_back(x / left);
    }
}

}  // namespace tribo::dynamics
