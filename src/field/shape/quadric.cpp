// SPDX-License-Identifier: MIT
#include "field/shape/quadric.hpp"

#include <cmath>

namespace tribo::field {
namespace {

// Computes the eigenvalues on the diagonal of m and the eigenvectors in the columns of v, by cyclic Jacobi
// rotations. Six sweeps are accurate to rounding for 3 x 3.
void diagonalise(double m[3][3], double v[3][3]) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) v[i][j] = i == j;
    }
    for (int sweep = 0; sweep < 6; ++sweep) {
        for (int p = 0; p < 2; ++p) {
            for (int q = p + 1; q < 3; ++q) {
                if (std::abs(m[p][q]) < 1e-300) continue;
                const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
                const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
                const double c = 1 / std::sqrt(t * t + 1), s = t * c;
                for (int k = 0; k < 3; ++k) {
                    const double a = m[k][p], b = m[k][q];
                    m[k][p] = c * a - s * b;
                    m[k][q] = s * a + c * b;
                }
                for (int k = 0; k < 3; ++k) {
                    const double a = m[p][k], b = m[q][k];
                    m[p][k] = c * a - s * b;
                    m[q][k] = s * a + c * b;
                }
                for (int k = 0; k < 3; ++k) {
                    const double a = v[k][p], b = v[k][q];
                    v[k][p] = c * a - s * b;
                    v[k][q] = s * a + c * b;
                }
            }
        }
    }
}

}  // namespace

void Quadric::add(Vec3 p, Vec3 n) {
    xx_ += n.x * n.x;
    xy_ += n.x * n.y;
    xz_ += n.x * n.z;
    yy_ += n.y * n.y;
    yz_ += n.y * n.z;
    zz_ += n.z * n.z;
    right_ += dot(n, p) * n;
    sum_ += p;
    normals_ += n;
    ++count_;
}

bool Quadric::is_flat(double tolerance) const {
    return length(normals_) > count_ * (1 - 0.5 * tolerance * tolerance);
}

Vec3 Quadric::solve_with(const std::array<bool, 3>& fixed, Vec3 offset, double cutoff) const {
    const Vec3 m = mean() + offset;
    Vec3 rest = right_ - Vec3{xx_ * m.x + xy_ * m.y + xz_ * m.z, xy_ * m.x + yy_ * m.y + yz_ * m.z,
                              xz_ * m.x + yz_ * m.y + zz_ * m.z};
    double a[3][3] = {{xx_, xy_, xz_}, {xy_, yy_, yz_}, {xz_, yz_, zz_}}, v[3][3];
    for (int i = 0; i < 3; ++i) {
        if (!fixed[static_cast<std::size_t>(i)]) continue;
        rest[i] = 0;
        for (int j = 0; j < 3; ++j) a[i][j] = a[j][i] = 0;
    }
    diagonalise(a, v);
    const double largest = std::max(a[0][0], std::max(a[1][1], a[2][2]));
    Vec3 x = m;
    for (int i = 0; i < 3; ++i) {
        if (a[i][i] <= cutoff * largest) continue;
        const Vec3 direction{v[0][i], v[1][i], v[2][i]};
        x += (dot(direction, rest) / a[i][i]) * direction;
    }
    return x;
}

Vec3 Quadric::solve_in(const Box3& box, double cutoff) const {
    std::array<bool, 3> fixed{};
    Vec3 offset;
    for (int n = 0; n < 3; ++n) {
        const Vec3 x = solve_with(fixed, offset, cutoff);
        int worst = -1;
        double most = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double beyond = std::max(box.min[axis] - x[axis], x[axis] - box.max[axis]);
            if (!fixed[static_cast<std::size_t>(axis)] && beyond > most) most = beyond, worst = axis;
        }
        if (worst < 0) return x;
        fixed[static_cast<std::size_t>(worst)] = true;
        const double side = x[worst] < box.min[worst] ? box.min[worst] : box.max[worst];
        offset[worst] = side - mean()[worst];
    }
    return mean() + offset;
}

}  // namespace tribo::field
