// SPDX-License-Identifier: MIT
// Linear systems whose matrix is zero away from its diagonal, as for splines. Any thread.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace tribo::motion {

// An n x n matrix with `lower` diagonals below and `upper` above the main one. Memory n (lower + upper + 1).
class BandedMatrix {
  public:
    BandedMatrix(std::size_t size, std::size_t lower, std::size_t upper)
        : size_(size), lower_(lower), upper_(upper), entries_(size * (lower + upper + 1), 0.0) {}

    std::size_t size() const { return size_; }
    // i and j < size, within the band.
    double& at(std::size_t i, std::size_t j) {
        assert(i < size_ && j < size_ && i <= j + lower_ && j <= i + upper_);
        return entries_[i * (lower_ + upper_ + 1) + j + lower_ - i];
    }

    // Replaces the right-hand side, of any vector space T, by the solution, and the matrix by its factors.
    // Elimination without row exchanges: stable for the matrices of splines, which are totally positive (de
    // Boor & Pinkus 1977) or positive definite. Returns false if a pivot is negligible beside the largest.
    template <class T>
    bool solve(std::vector<T>& right) {
        assert(right.size() == size_);
        double largest = 0;
        for (std::size_t k = 0; k < size_; ++k) {
            const double pivot = at(k, k);
            largest = std::max(largest, pivot);
            if (!(pivot > kSingular * largest)) return false;
            for (std::size_t i = k + 1; i <= std::min(size_ - 1, k + lower_); ++i) {
                const double factor = at(i, k) / pivot;
                if (factor == 0) continue;
                for (std::size_t j = k + 1; j <= std::min(size_ - 1, k + upper_); ++j)
                    at(i, j) -= factor * at(k, j);
                right[i] = right[i] + (-factor) * right[k];
            }
        }
        for (std::size_t i = size_; i-- > 0;) {
            for (std::size_t j = i + 1; j <= std::min(size_ - 1, i + upper_); ++j)
                right[i] = right[i] + (-at(i, j)) * right[j];
            right[i] = (1 / at(i, i)) * right[i];
        }
        return true;
    }

  private:
    // A pivot this small relative to the largest leaves no digits in the solution.
    static constexpr double kSingular = 1e-14;

    std::size_t size_, lower_, upper_;
    std::vector<double> entries_;
};

}  // namespace tribo::motion
