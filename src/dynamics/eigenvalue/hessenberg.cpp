// SPDX-License-Identifier: MIT
#include "dynamics/eigenvalue/hessenberg.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tribo::dynamics {
namespace {

class Shrinking {
  public:
    Shrinking(std::vector<double> matrix, std::size_t size) : a_(std::move(matrix)), size_(size) {
        for (std::size_t row = 0; row < size; ++row)
            for (std::size_t column = row > 0 ? row - 1 : 0; column < size; ++column)
                norm_ += std::abs(at(row, column));
    }

    std::vector<std::complex<double>> eigenvalues() {
        // The last row and column that are left, and steps since one or two went.
        for (std::size_t count = size_, steps = 0; count > 0;) {
            const std::size_t last = count - 1, first = first_of_block(last);
            // What does not shrink is taken as it stands: never seen.
            const bool given_up = steps == kMostSteps;
            if (first == last || (given_up && last == 0)) {
                found_.emplace_back(at(last, last) + shifted_, 0.0);
                --count;
                steps = 0;
            } else if (first + 1 == last || given_up) {
                add_pair(last);
                count -= 2;
                steps = 0;
            } else {
                step(first, last, ++steps);
            }
        }
        return std::move(found_);
    }

  private:
    static constexpr std::size_t kMostSteps = 60;

    double& at(std::size_t row, std::size_t column) { return a_[row * size_ + column]; }

    // The first row of the block at the end that the lower diagonal holds together.
    std::size_t first_of_block(std::size_t last) {
        std::size_t row = last;
        for (; row > 0; --row) {
            double size = std::abs(at(row - 1, row - 1)) + std::abs(at(row, row));
            if (size == 0) size = norm_;
            if (std::abs(at(row, row - 1)) > std::numeric_limits<double>::epsilon() * size) continue;
            at(row, row - 1) = 0;
            break;
        }
        return row;
    }

    // Of the last two rows and columns.
    void add_pair(std::size_t last) {
        const double x = at(last, last), y = at(last - 1, last - 1);
        const double w = at(last, last - 1) * at(last - 1, last);
        const double half = 0.5 * (y - x), square = half * half + w, root = std::sqrt(std::abs(square));
        if (square < 0) {
            for (const double sign : {1.0, -1.0}) found_.emplace_back(x + half + shifted_, sign * root);
            return;
        }
        const double z = half + (half < 0 ? -root : root);
        found_.emplace_back(x + z + shifted_, 0.0);
        found_.emplace_back((z != 0 ? x - w / z : x) + shifted_, 0.0);
    }

    void step(std::size_t first, std::size_t last, std::size_t number) {
        double x = at(last, last), y = at(last - 1, last - 1), w = at(last, last - 1) * at(last - 1, last);
        if (number % 10 == 0) {
            // Another shift, where the usual ones go round in circles.
            shifted_ += x;
            for (std::size_t n = 0; n <= last; ++n) at(n, n) -= x;
            const double size = std::abs(at(last, last - 1)) + std::abs(at(last - 1, last - 2));
            x = y = 0.75 * size;
            w = -0.4375 * size * size;
        }
        // Begins where two small numbers in a row let it.
        std::size_t from = last - 2;
        double p = 0, q = 0, r = 0;
        for (;; --from) {
            const double z = at(from, from), xz = x - z, yz = y - z;
            p = (xz * yz - w) / at(from + 1, from) + at(from, from + 1);
            q = at(from + 1, from + 1) - z - xz - yz;
            r = at(from + 2, from + 1);
            const double size = std::abs(p) + std::abs(q) + std::abs(r);
            p /= size;
            q /= size;
            r /= size;
            if (from == first) break;
            const double small = std::abs(at(from, from - 1)) * (std::abs(q) + std::abs(r));
            const double large = std::abs(p) * (std::abs(at(from - 1, from - 1)) + std::abs(z) +
                                                std::abs(at(from + 1, from + 1)));
            if (small <= std::numeric_limits<double>::epsilon() * large) break;
        }
        for (std::size_t row = from + 2; row <= last; ++row) {
            at(row, row - 2) = 0;
            if (row > from + 2) at(row, row - 3) = 0;
        }
        for (std::size_t k = from; k < last; ++k) {
            const bool three = k + 1 < last;
            double scale = 1;
            if (k != from) {
                p = at(k, k - 1);
                q = at(k + 1, k - 1);
                r = three ? at(k + 2, k - 1) : 0;
                scale = std::abs(p) + std::abs(q) + std::abs(r);
                if (scale == 0) continue;
                p /= scale;
                q /= scale;
                r /= scale;
            }
            const double length = std::sqrt(p * p + q * q + r * r), s = p < 0 ? -length : length;
            if (s == 0) continue;
            if (k != from) {
                at(k, k - 1) = -s * scale;
            } else if (first != from) {
                at(k, k - 1) = -at(k, k - 1);
            }
            reflect(k, last, first, three, p, q, r, s);
        }
    }

    void reflect(std::size_t k, std::size_t last, std::size_t first, bool three, double p, double q, double r,
                 double s) {
        p += s;
        const double x = p / s, y = q / s, z = r / s;
        q /= p;
        r /= p;
        for (std::size_t column = k; column <= last; ++column) {
            double sum = at(k, column) + q * at(k + 1, column);
            if (three) {
                sum += r * at(k + 2, column);
                at(k + 2, column) -= sum * z;
            }
            at(k + 1, column) -= sum * y;
            at(k, column) -= sum * x;
        }
        for (std::size_t row = first; row <= std::min(last, k + 3); ++row) {
            double sum = x * at(row, k) + y * at(row, k + 1);
            if (three) {
                sum += z * at(row, k + 2);
                at(row, k + 2) -= sum * r;
            }
            at(row, k + 1) -= sum * q;
            at(row, k) -= sum;
        }
    }

    std::vector<double> a_;
    std::size_t size_;
    double norm_ = 0, shifted_ = 0;
    std::vector<std::complex<double>> found_;
};

}  // namespace

std::vector<std::complex<double>> hessenberg_eigenvalues(std::vector<double> matrix, std::size_t size) {
    return Shrinking(std::move(matrix), size).eigenvalues();
}

}  // namespace tribo::dynamics
