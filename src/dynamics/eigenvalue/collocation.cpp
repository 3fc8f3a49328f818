// SPDX-License-Identifier: MIT
#include "dynamics/eigenvalue/collocation.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace tribo::dynamics {
namespace {

struct Legendre {
    double value, slope;
};

Legendre legendre(int degree, double x) {
    double before = 1, now = x;
    for (int n = 2; n <= degree; ++n) {
        const double next = ((2 * n - 1) * x * now - (n - 1) * before) / n;
        before = now;
        now = next;
    }
    return {now, degree * (x * now - before) / (x * x - 1)};
}

}  // namespace

GaussPoints::GaussPoints(int count) {
    constexpr int kNewtonSteps = 8;
    for (int k = 0; k < count; ++k) {
        double at = -math::cos(math::kPi * (k + 0.75) / (count + 0.5));
        for (int n = 0; n < kNewtonSteps; ++n) {
            const Legendre p = legendre(count, at);
            at -= p.value / p.slope;
        }
        const double slope = legendre(count, at).slope;
        x.push_back(0.5 * (1 + at));
        weight.push_back(1 / ((1 - at * at) * slope * slope));
        // Wang and Xiang 2012, theorem 3.1.
        barycentric_.push_back((k % 2 == 0 ? 1 : -1) * std::sqrt((1 - at * at) * weight.back()));
    }
    const std::size_t n = x.size();
    std::vector<double> share(n);
    once.resize((n + 1) * n);
    twice.resize((n + 1) * n);
    for (std::size_t row = 0; row <= n; ++row) {
        const double end = row < n ? x[row] : 1;
        // The rule, shrunk to [0, end], is exact for the polynomial.
        for (std::size_t k = 0; k < n; ++k) {
            shares(end * x[k], share.data());
            for (std::size_t l = 0; l < n; ++l) once[row * n + l] += end * weight[k] * share[l];
        }
    }
    for (std::size_t row = 0; row <= n; ++row)
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t l = 0; l < n; ++l) twice[row * n + l] += once[row * n + k] * once[k * n + l];
}

void GaussPoints::shares(double at, double* out) const {
    double sum = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double apart = at - x[k];
        if (apart == 0) {
            std::fill_n(out, x.size(), 0.0);
            out[k] = 1;
            return;
        }
        out[k] = barycentric_[k] / apart;
        sum += out[k];
    }
    for (std::size_t k = 0; k < x.size(); ++k) out[k] /= sum;
}

void eliminate(std::size_t count, std::size_t width, double* matrix) {
    for (std::size_t c = 0; c < count; ++c) {
        double* row = matrix + c * width;
        std::size_t pivot = c;
        for (std::size_t r = c + 1; r < count; ++r)
            if (std::abs(matrix[r * width + c]) > std::abs(matrix[pivot * width + c])) pivot = r;
        if (pivot != c) std::swap_ranges(row + c, row + width, matrix + pivot * width + c);
        const double inverse = 1 / row[c];
        for (std::size_t r = c + 1; r < count; ++r) {
            double* other = matrix + r * width;
            const double factor = other[c] * inverse;
            for (std::size_t k = c + 1; k < width; ++k) other[k] -= factor * row[k];
        }
    }
    for (std::size_t c = count; c-- > 0;) {
        double* row = matrix + c * width;
        const double inverse = 1 / row[c];
        for (std::size_t k = count; k < width; ++k) row[k] *= inverse;
        for (std::size_t r = 0; r < c; ++r) {
            double* other = matrix + r * width;
            const double factor = other[c];
            for (std::size_t k = count; k < width; ++k) other[k] -= factor * row[k];
        }
    }
}

}  // namespace tribo::dynamics
