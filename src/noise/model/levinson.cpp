// SPDX-License-Identifier: MIT
#include "noise/model/levinson.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "noise/model/ar_model.hpp"

namespace tribo::noise {
namespace {

double bounded(double k) {
    return std::clamp(k, -kLargestReflection, kLargestReflection);
}

}  // namespace

std::vector<double> levinson(std::span<const double> autocorrelation, double white) {
    assert(!autocorrelation.empty() && autocorrelation[0] > 0);
    const std::size_t order = autocorrelation.size() - 1;
    std::vector<double> reflection(order), a(order), before(order);
    double error = autocorrelation[0] * (1 + white);
    for (std::size_t m = 0; m < order; ++m) {
        double sum = autocorrelation[m + 1];
        for (std::size_t i = 0; i < m; ++i) sum += a[i] * autocorrelation[m - i];
        const double k = bounded(-sum / error);
        reflection[m] = k;
        std::copy_n(a.begin(), m, before.begin());
        for (std::size_t i = 0; i < m; ++i) a[i] = before[i] + k * before[m - 1 - i];
        a[m] = k;
        error *= 1 - k * k;
    }
    return reflection;
}

std::vector<double> burg(std::span<const std::span<const double>> stretches, int order) {
    struct Errors {
        std::vector<double> forward, backward;
    };
    const auto poles = static_cast<std::size_t>(order);
    std::vector<Errors> all;
    for (const std::span<const double> x : stretches) {
        if (x.size() > poles) all.push_back({{x.begin(), x.end()}, {x.begin(), x.end()}});
    }
    std::vector<double> reflection(poles);
    for (std::size_t m = 0; m < poles; ++m) {
        double product = 0, energy = 0;
        for (const Errors& e : all) {
            for (std::size_t n = m + 1; n < e.forward.size(); ++n) {
                const double f = e.forward[n], b = e.backward[n - 1];
                product += f * b;
                energy += f * f + b * b;
            }
        }
        const double k = energy > 0 ? bounded(-2 * product / energy) : 0;
        reflection[m] = k;
        for (Errors& e : all) {
            for (std::size_t n = e.forward.size() - 1; n > m; --n) {
                const double f = e.forward[n], b = e.backward[n - 1];
                e.forward[n] = f + k * b;
                e.backward[n] = b + k * f;
            }
        }
    }
    return reflection;
}

}  // namespace tribo::noise
