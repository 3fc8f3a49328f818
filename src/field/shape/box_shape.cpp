// SPDX-License-Identifier: MIT
#include "field/shape/box_shape.hpp"

#include <algorithm>

namespace tribo::field {

double BoxShape::distance_mm(Vec3 p) const {
    const double x = std::max(box_.min.x - p.x, p.x - box_.max.x);
    const double y = std::max(box_.min.y - p.y, p.y - box_.max.y);
    const double z = std::max(box_.min.z - p.z, p.z - box_.max.z);
    return std::max(x, std::max(y, z));
}

Vec3 BoxShape::gradient(Vec3 p) const {
    Vec3 best{0, 0, 1};
    double largest = p.z - box_.max.z;
    for (int axis = 0; axis < 3; ++axis) {
        const double below = box_.min[axis] - p[axis], above = p[axis] - box_.max[axis];
        if (std::max(below, above) > largest) {
            largest = std::max(below, above);
            best = {};
            best[axis] = below > above ? -1 : 1;
        }
    }
    return best;
}

void BoxShape::sample(const Lattice& lattice, float* out) const {
    float along[3][kLatticeEdge];
    for (int n = 0; n < kLatticeEdge; ++n) {
        const Vec3 p = lattice.node(n, n, n);
        for (int axis = 0; axis < 3; ++axis) {
            along[axis][n] = static_cast<float>(std::max(box_.min[axis] - p[axis], p[axis] - box_.max[axis]));
        }
    }
    for (int c = 0; c < kLatticeEdge; ++c) {
        for (int b = 0; b < kLatticeEdge; ++b) {
            const float yz = std::max(along[1][b], along[2][c]);
            for (int a = 0; a < kLatticeEdge; ++a) *out++ = std::max(along[0][a], yz);
        }
    }
}

}  // namespace tribo::field
