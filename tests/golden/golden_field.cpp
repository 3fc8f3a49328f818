// SPDX-License-Identifier: MIT
#include <memory>

#include "base/hash.hpp"
#include "base/noise_hash.hpp"
#include "field/carved/carved_field.hpp"
#include "field/contour/contour.hpp"
#include "field/shape/box_shape.hpp"
#include "golden/golden.hpp"

namespace tribo::golden {

// A block with overlapping notches: removed volumes, distances, normals, mesh.
std::uint64_t field() {
    Hash hash;
    field::CarvedField stock(std::make_unique<field::BoxShape>(Box3{{-10, -8, -6}, {10, 8, 0}}), 0.5);
    const CounterNoise noise(3);
    for (std::uint64_t i = 0; i < 12; ++i) {
        const Vec3 corner{20 * noise.uniform(4 * i) - 10, 16 * noise.uniform(4 * i + 1) - 8,
                          -3 * noise.uniform(4 * i + 2)};
        hash.add(stock.carve(std::make_unique<field::BoxShape>(Box3{corner, corner + Vec3{3.3, 4.7, 5}})));
    }
    for (std::uint64_t i = 100; i < 2'000; ++i) {
        const Vec3 p{20 * noise.uniform(4 * i) - 10, 16 * noise.uniform(4 * i + 1) - 8,
                     -6 * noise.uniform(4 * i + 2)};
        hash.add(stock.distance_mm(p));
        hash.add(stock.normal(p));
    }
    const TriangleMesh mesh = field::contour(stock);
    for (const Point3f& p : mesh.positions) hash.add(p);
    for (const Triangle& t : mesh.triangles) hash.add(t);
    return hash.value();
}

}  // namespace tribo::golden
