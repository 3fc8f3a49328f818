// SPDX-License-Identifier: MIT
#include "job/turned_shape.hpp"

#include <utility>

namespace tribo::job {

TurnedShape::TurnedShape(std::unique_ptr<const field::Shape> solid, const motion::WorkFrame& frame,
                         const Box3& bounds_mm)
    : solid_(std::move(solid)), frame_(frame), bounds_(bounds_mm) {}

void TurnedShape::sample(const field::Lattice& lattice, float* out) const {
    for (int c = 0; c < field::kLatticeEdge; ++c) {
        for (int b = 0; b < field::kLatticeEdge; ++b) {
            for (int a = 0; a < field::kLatticeEdge; ++a)
                *out++ = static_cast<float>(distance_mm(lattice.node(a, b, c)));
        }
    }
}

}  // namespace tribo::job
