// SPDX-License-Identifier: MIT
// Against the eigenvalues that Eigen computes.
#include "dynamics/eigenvalue/hessenberg.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <gtest/gtest.h>

namespace tribo::dynamics {
namespace {

std::vector<std::complex<double>> eigenvalues(const Eigen::MatrixXd& m) {
    const auto size = static_cast<std::size_t>(m.rows());
    std::vector<double> rows(size * size);
    for (std::size_t r = 0; r < size; ++r)
        for (std::size_t c = 0; c < size; ++c)
            rows[r * size + c] = m(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
    return hessenberg_eigenvalues(rows, size);
}

// Each has a partner of its own.
void expect_same(std::vector<std::complex<double>> found, const Eigen::VectorXcd& expected, double off) {
    ASSERT_EQ(found.size(), static_cast<std::size_t>(expected.size()));
    for (const std::complex<double>& value : expected) {
        const auto nearest = std::min_element(found.begin(), found.end(), [&](auto a, auto b) {
            return std::abs(a - value) < std::abs(b - value);
        });
        EXPECT_LT(std::abs(*nearest - value), off * std::max(1.0, std::abs(value)));
        found.erase(nearest);
    }
}

TEST(HessenbergEigenvalues, AreThoseOfRandomMatrices) {
    std::srand(7);
    for (int size = 1; size <= 40; ++size) {
        for (int n = 0; n < 10; ++n) {
            Eigen::MatrixXd m = Eigen::MatrixXd::Random(size, size);
            for (int c = 0; c < size; ++c)
                for (int r = c + 2; r < size; ++r) m(r, c) = 0;
            expect_same(eigenvalues(m), m.eigenvalues(), 1e-11);
        }
    }
}

TEST(HessenbergEigenvalues, OfMatricesThatDoNotShrinkByThemselves) {
    // A cycle: the usual shifts leave it as it is.
    for (const int size : {2, 3, 4, 7, 12}) {
        Eigen::MatrixXd cycle = Eigen::MatrixXd::Zero(size, size);
        for (int n = 0; n + 1 < size; ++n) cycle(n + 1, n) = 1;
        cycle(0, size - 1) = 1;
        expect_same(eigenvalues(cycle), cycle.eigenvalues(), 1e-11);
    }
    const Eigen::MatrixXd nothing = Eigen::MatrixXd::Zero(5, 5);
    expect_same(eigenvalues(nothing), nothing.eigenvalues(), 1e-11);
    Eigen::MatrixXd diagonal = Eigen::MatrixXd::Zero(3, 3);
    diagonal.diagonal() << 3, -2, 1e-9;
    expect_same(eigenvalues(diagonal), diagonal.eigenvalues(), 1e-11);
}

}  // namespace
}  // namespace tribo::dynamics
