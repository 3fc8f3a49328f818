// SPDX-License-Identifier: MIT
#include "field/contour/contour_corner.hpp"

#include <algorithm>
#include <cmath>

#include "field/shape/quadric.hpp"

namespace tribo::field {

double distance_to_face(const CarvedField& field, ShapeId shape, Vec3 p) {
    const double d = field.shape(shape).distance_mm(p);
    return shape == 0 ? d : -d;
}

Vec3 normal_of_face(const CarvedField& field, ShapeId shape, Vec3 p) {
    const Vec3 g = field.shape(shape).gradient(p);
    return shape == 0 ? g : -g;
}

FacePoint tangent_near(const CarvedField& field, const FacePoint& x, Vec3 p, double back) {
    const Vec3 beside = lerp(p - dot(p - x.point, x.normal) * x.normal, x.point, back);
    const Vec3 n = normal_of_face(field, x.shape, beside);
    constexpr double kSameFace = 0.8;  // cosine of the turn within a cell
    if (dot(n, x.normal) < kSameFace) return x;
    // A curved face turns by half on half of the way, an edge of the shape at once.
    constexpr double kFlat = 0.05, kUneven = 0.3;  // rad; of the turn
    const double turn = length(n - x.normal);
    if (turn > kFlat) {
        const double half = length(normal_of_face(field, x.shape, 0.5 * (beside + x.point)) - x.normal);
        if (std::abs(half - 0.5 * turn) > kUneven * turn) return x;
    }
    return {beside - distance_to_face(field, x.shape, beside) * n, n, x.shape};
}

std::optional<Vec3> on_surface(const CarvedField& field, Vec3 p, double within_mm) {
    constexpr int kMostSteps = 6;
    for (int n = 0; n < kMostSteps; ++n) {
        const contact::SurfaceSample s = field.sample(p);
        if (std::abs(s.distance_mm) < within_mm) return p;
        p -= s.distance_mm * s.normal;
    }
    return std::nullopt;
}

Vec3 corner_on_face(const CarvedField& field, BrickRef ref, Vec3 from, Vec3 to, int axis, Vec3 low,
                    double off_mm) {
    constexpr double kSmooth = 0.995;  // cosine of 0.1 rad
    const Vec3 middle = 0.5 * (from + to);
    const auto face_at = [&](Vec3 p) {
        const ShapeId shape = field.exact(ref, p).shape;
        return FacePoint{p, normal_of_face(field, shape, p), shape};
    };
    const FacePoint ends[2] = {face_at(from), face_at(to)};
    if (dot(ends[0].normal, ends[1].normal) > kSmooth) return middle;
    Vec3 across;
    across[axis] = 1;
    Vec3 p = middle;
    for (const double back : {1.0, 0.3, 0.03}) {
        Quadric planes;
        planes.add(middle, across);
        for (const FacePoint& end : ends) {
            const FacePoint t = tangent_near(field, end, p, back);
            // Its trace on the face of the grid.
            const Vec3 along = t.normal - t.normal[axis] * across;
            const double steep = squared_length(along), off = t.normal[axis] * (t.point[axis] - middle[axis]);
            if (steep == 0) return middle;
            Vec3 on = t.point + off / steep * along;
            on[axis] = middle[axis];
            planes.add(on, along / std::sqrt(steep));
        }
        p = planes.solve();
        for (int k = 0; k < 3; ++k)
            p[k] = std::clamp(p[k], low[k] + off_mm, low[k] + field.cell_mm() - off_mm);
        p[axis] = middle[axis];
    }
    const auto off_surface = [&](Vec3 q) { return std::abs(field.exact(ref, q).distance_mm); };
    return off_surface(p) < off_surface(middle) ? p : middle;
}

}  // namespace tribo::field
