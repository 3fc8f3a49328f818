// SPDX-License-Identifier: MIT
#include "dynamics/eigenvalue/largest_eigenvalue.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace tribo::dynamics {
namespace {

// A random matrix with these eigenvalues.
Eigen::MatrixXd with_eigenvalues(const Eigen::MatrixXd& blocks) {
    std::srand(5);
    const Eigen::MatrixXd basis = Eigen::MatrixXd::Random(blocks.rows(), blocks.rows());
    return basis * blocks * basis.inverse();
}

Eigenpair largest_pair(const Eigen::MatrixXd& m, std::size_t inputs) {
    const auto size = static_cast<std::size_t>(m.rows());
    return largest_eigenvalue(size, inputs, [&](const double* from, double* to) {
        Eigen::Map<Eigen::VectorXd>(to, m.rows()) = m * Eigen::Map<const Eigen::VectorXd>(from, m.rows());
    });
}

std::complex<double> largest(const Eigen::MatrixXd& m, std::size_t inputs) {
    return largest_pair(m, inputs).value;
}

TEST(LargestEigenvalue, is_found_beside_many_smaller_ones) {
    for (const int size : {1, 2, 6, 40}) {
        Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(size, size);
        for (int n = 0; n < size; ++n) blocks(n, n) = -2 * std::pow(0.8, n);
        EXPECT_NEAR(std::abs(largest(with_eigenvalues(blocks), 1) + 2.0), 0, 1e-8) << size;
    }
}

TEST(LargestEigenvalue, may_be_complex_and_hardly_the_largest) {
    Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(30, 30);
    for (int n = 0; n < 30; ++n) blocks(n, n) = 0.9 * std::pow(0.7, n);
    blocks.topLeftCorner(4, 4) << 0.6, 0.8, 0, 0, -0.8, 0.6, 0, 0, 0, 0, -0.3, 0.954, 0, 0, -0.954, -0.3;
    const std::complex<double> found = largest(with_eigenvalues(blocks), 2);
    // The second pair has the size 1.00006.
    EXPECT_NEAR(found.real(), -0.3, 1e-7);
    EXPECT_NEAR(std::abs(found.imag()), 0.954, 1e-7);
}

TEST(LargestEigenvalue, comes_with_its_vector) {
    Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(30, 30);
    for (int n = 0; n < 30; ++n) blocks(n, n) = 0.9 * std::pow(0.7, n);
    blocks.topLeftCorner(2, 2) << 0.6, 0.8, -0.8, 0.6;
    const Eigen::MatrixXd m = with_eigenvalues(blocks);
    const Eigenpair found = largest_pair(m, 2);
    const Eigen::VectorXcd v = Eigen::Map<const Eigen::VectorXcd>(found.vector.data(), 30);
    EXPECT_NEAR(v.norm(), 1, 1e-9);
    EXPECT_LT((m * v - found.value * v).norm(), 1e-8);
}

TEST(LargestEigenvalue, of_nothing_is_zero) {
    EXPECT_EQ(largest(Eigen::MatrixXd::Zero(5, 5), 2), 0.0);
    // Nilpotent: the third image is zero.
    Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(3, 3);
    shift(0, 1) = shift(1, 2) = 1;
    EXPECT_EQ(largest(shift, 1), 0.0);
}

}  // namespace
}  // namespace tribo::dynamics
