// SPDX-License-Identifier: MIT
#include "job/solid.hpp"

#include <cmath>
#include <utility>

#include "base/hash.hpp"
#include "base/text/limit_text.hpp"
#include "field/shape/box_shape.hpp"
#include "job/turned_shape.hpp"

namespace tribo::job {
namespace {

bool is_along_an_axis(Vec3 unit) {
    return std::abs(unit.x) == 1 || std::abs(unit.y) == 1 || std::abs(unit.z) == 1;
}

// Of a mesh by its vertices, of a box by its corners.
Box3 bounds_in_frame(const Solid& solid, const motion::WorkFrame& frame) {
    Box3 bounds;
    if (solid.mesh) {
        const TriangleMesh& mesh = solid.mesh->mesh();
        for (const Triangle& t : mesh.triangles) {
            for (const std::uint32_t corner : t) bounds.include(frame.from_stock(mesh.position(corner)));
        }
        return bounds;
    }
    for (int corner = 0; corner < 8; ++corner) {
        const auto side = [&](int axis) {
            return (corner >> axis & 1) != 0 ? solid.box_mm.max[axis] : solid.box_mm.min[axis];
        };
        bounds.include(frame.from_stock({side(0), side(1), side(2)}));
    }
    return bounds;
}

}  // namespace

Result<void> check_place(const Box3& box_mm) {
    if (box_mm.empty()) return {};
    for (const Vec3& corner : {box_mm.min, box_mm.max}) {
        for (int axis = 0; axis < 3; ++axis) {
            if (kLimits.coordinate.range.contains(corner[axis])) continue;
            return fail(out_of_range(kLimits.coordinate, corner[axis]), range_remedy(kLimits.coordinate));
        }
    }
    return {};
}

Result<void> check_edges(Vec3 size_mm) {
    for (int axis = 0; axis < 3; ++axis) {
        if (kLimits.edge.range.contains(size_mm[axis])) continue;
        return fail(out_of_range(kLimits.edge, size_mm[axis]), range_remedy(kLimits.edge));
    }
    return {};
}

Result<void> check_room(const Box3& box_mm) {
    if (auto done = check_place(box_mm); !done) return done;
    return check_edges(box_mm.size());
}

Solid box_solid(const Box3& box_mm) {
    Solid solid;
    solid.volume_mm3 = box_mm.volume();
    const Vec3 edge = box_mm.size();
    solid.thickness_mm = 1 / (1 / edge.x + 1 / edge.y + 1 / edge.z);
    solid.box_mm = box_mm;
    Hash hash;
    hash.add(box_mm.min);
    hash.add(box_mm.max);
    solid.hash = hash.value();
    return solid;
}

Result<Solid> mesh_solid(TriangleMesh mesh, const std::string& file) {
    auto shape = field::MeshShape::make(std::move(mesh));
    if (!shape) {
        Error error = shape.error();
        error.file = file;
        return std::unexpected(std::move(error));
    }
    Solid solid;
    solid.mesh = **shape;
    const TriangleMesh& kept = solid.mesh->mesh();
    solid.volume_mm3 = solid.mesh->volume_mm3();
    solid.thickness_mm = 2 * solid.volume_mm3 / area_mm2(kept);
    Hash hash;
    for (const auto& p : kept.positions) {
        for (const float v : p) hash.add(v);
    }
    for (const Triangle& t : kept.triangles) {
        for (const auto v : t) hash.add(v);
    }
    solid.hash = hash.value();
    return solid;
}

std::unique_ptr<const field::Shape> shape_of(const Solid& solid, const motion::WorkFrame& frame) {
    const auto as_it_stands = [&]() -> std::unique_ptr<const field::Shape> {
        if (solid.mesh) return std::make_unique<field::MeshShape>(*solid.mesh);
        return std::make_unique<field::BoxShape>(solid.box_mm);
    };
    const bool same = frame.origin_mm == Vec3{} && frame.x == Vec3{1, 0, 0} && frame.y == Vec3{0, 1, 0} &&
                      frame.z == Vec3{0, 0, 1};
    if (same) return as_it_stands();
    const Box3 bounds = bounds_in_frame(solid, frame);
    if (!solid.mesh && is_along_an_axis(frame.x) && is_along_an_axis(frame.z)) {
        return std::make_unique<field::BoxShape>(bounds);
    }
    return std::make_unique<TurnedShape>(as_it_stands(), frame, bounds);
}

}  // namespace tribo::job
