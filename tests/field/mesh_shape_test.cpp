// SPDX-License-Identifier: MIT
// Distance to meshes: against every triangle in turn, against boxes and spheres, and the side at every kind
// of edge and corner.
#include "field/mesh/mesh_shape.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>

#include "field/shape/box_shape.hpp"
#include "mesh_samples.hpp"

namespace tribo::field {
namespace {

using test::box_mesh;
using test::sphere_mesh;

std::unique_ptr<MeshShape> shape_of(TriangleMesh mesh) {
    auto made = MeshShape::make(std::move(mesh));
    EXPECT_TRUE(made.has_value()) << (made ? "" : made.error().text());
    return made ? std::move(*made) : nullptr;
}

// Unsigned, by looking at every triangle: the least distance over the plane's foot and the three edges.
double brute_distance(const TriangleMesh& mesh, Vec3 p) {
    double best = std::numeric_limits<double>::infinity();
    for (const Triangle& t : mesh.triangles) {
        const Vec3 v[3] = {mesh.position(t[0]), mesh.position(t[1]), mesh.position(t[2])};
        for (int i = 0; i < 3; ++i) {
            const Vec3 a = v[i], edge = v[(i + 1) % 3] - a;
            const double s = std::clamp(dot(p - a, edge) / squared_length(edge), 0.0, 1.0);
            best = std::min(best, distance(p, a + s * edge));
        }
        const Vec3 n = normalized(cross(v[1] - v[0], v[2] - v[0]));
        const Vec3 foot = p - dot(p - v[0], n) * n;
        bool inside = true;
        for (int i = 0; i < 3; ++i) inside &= dot(cross(v[(i + 1) % 3] - v[i], foot - v[i]), n) >= 0;
        if (inside) best = std::min(best, distance(p, foot));
    }
    return best;
}

// A crown of sharp spikes and notches: a closed ring of triangles whose corners go up and down at random.
TriangleMesh crown(const std::vector<int>& heights) {
    TriangleMesh mesh;
    const auto n = static_cast<std::uint32_t>(heights.size());
    mesh.positions = {{0, 0, 0}, {0, 0, -3}};
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 6.283185307179586 * i / n;
        mesh.positions.push_back(to_float({4 * std::cos(angle), 4 * std::sin(angle), 0.5 * heights[i]}));
        mesh.triangles.push_back({0, 2 + i, 2 + (i + 1) % n});
        mesh.triangles.push_back({1, 2 + (i + 1) % n, 2 + i});
    }
    return mesh;
}

Vec3 any_point(double reach) {
    const auto coordinate = rc::gen::inRange(-1000, 1001);
    const int x = *coordinate, y = *coordinate, z = *coordinate;
    return (reach / 1000) * Vec3{double(x), double(y), double(z)};
}

RC_GTEST_PROP(MeshShape, distance_and_side_match_a_look_at_every_triangle, ()) {
    const auto heights = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-4, 20));
    RC_PRE(heights.size() >= 3U);
    const TriangleMesh mesh = crown(heights);
    const auto made = MeshShape::make(mesh);
    RC_ASSERT(made.has_value());
    for (int i = 0; i < 20; ++i) {
        const Vec3 p = any_point(8);
        const double d = (*made)->distance_mm(p), expected = brute_distance(mesh, p);
        RC_ASSERT(std::abs(std::abs(d) - expected) < 1e-9);
        if (expected > 1e-9) RC_ASSERT((d < 0) == (test::turns_about(mesh, p) > 0.5));
    }
}

RC_GTEST_PROP(MeshShape, distance_grows_no_faster_than_the_way, ()) {
    static const auto sphere = shape_of(sphere_mesh({1, 2, 3}, 5, 3));
    const Vec3 p = any_point(12), q = any_point(12);
    RC_ASSERT(std::abs(sphere->distance_mm(p) - sphere->distance_mm(q)) <= distance(p, q) * (1 + 1e-12));
}

TEST(MeshShape, a_box_has_the_distance_of_a_box) {
    const Box3 box{{-1, -2, -3}, {4, 3, 2}};
    const auto shape = shape_of(box_mesh(box));
    EXPECT_EQ(shape->bounds_mm().min, box.min);
    EXPECT_EQ(shape->bounds_mm().max, box.max);
    const BoxShape exact(box);
    for (double x = -2.9; x < 6; x += 0.7) {
        for (double y = -3.9; y < 5; y += 0.7) {
            for (double z = -4.9; z < 4; z += 0.7) {
                const Vec3 p{x, y, z};
                const Vec3 beyond{std::max({box.min.x - x, 0.0, x - box.max.x}),
                                  std::max({box.min.y - y, 0.0, y - box.max.y}),
                                  std::max({box.min.z - z, 0.0, z - box.max.z})};
                const double expected = box.contains(p) ? exact.distance_mm(p) : length(beyond);
                EXPECT_NEAR(shape->distance_mm(p), expected, 1e-12);
            }
        }
    }
}

TEST(MeshShape, a_fine_sphere_has_the_distance_of_a_sphere) {
    const Vec3 centre{10, -20, 30};
    const auto shape = shape_of(sphere_mesh(centre, 8, 5));
    // Flat faces lie inside the sphere by up to their circumradius squared over the diameter: 0.011 mm here.
    for (const double radius : {0.5, 4.0, 7.9, 8.1, 9.0, 30.0}) {
        for (int i = 0; i < 200; ++i) {
            const double z = (i + 0.5) / 100 - 1, angle = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
            const Vec3 u{r * std::cos(angle), r * std::sin(angle), z};
            const double d = shape->distance_mm(centre + radius * u);
            EXPECT_LE(std::abs(d - (radius - 8)), 0.011);
            EXPECT_GT(dot(shape->gradient(centre + radius * u), u), 0.99);
        }
    }
}

TEST(MeshShape, lattices_give_the_distances_of_their_nodes_and_agree_where_they_meet) {
    const auto shape = shape_of(sphere_mesh({0, 0, 0}, 5, 4));
    const Lattice one{{-6.1, -6.2, -6.3}, 0.37, 7, 14, 0}, two{{-6.1, -6.2, -6.3}, 0.37, 14, 14, 0};
    float a[kLatticeNodes], b[kLatticeNodes];
    shape->sample(one, a);
    shape->sample(two, b);
    for (int k = 0; k < 8; ++k) {
        for (int j = 0; j < 8; ++j) {
            for (int i = 0; i < 8; ++i) {
                EXPECT_EQ(a[i + 8 * j + 64 * k], static_cast<float>(shape->distance_mm(one.node(i, j, k))));
            }
            EXPECT_EQ(a[7 + 8 * j + 64 * k], b[8 * j + 64 * k]);
        }
    }
}

TEST(MeshShape, slivers_without_area_do_not_mislead_the_side) {
    // A box whose edge from 0 to 1 carries a vertex in its middle on the lower side only, closed by a
    // triangle without area.
    TriangleMesh mesh = box_mesh({{0, 0, 0}, {2, 2, 2}});
    const TriangleMesh plain = mesh;
    mesh.positions.push_back({1, 0, 0});
    std::vector<Triangle> triangles;
    for (const Triangle& t : mesh.triangles) {
        if (t == Triangle{0, 3, 1}) {  // lower face: split at the middle of its edge 1 to 0
            triangles.push_back({0, 3, 8});
            triangles.push_back({8, 3, 1});
        } else {
            triangles.push_back(t);
        }
    }
    triangles.push_back({0, 8, 1});
    mesh.triangles = triangles;
    ASSERT_TRUE(is_closed(mesh));
    const auto shape = shape_of(mesh), exact = shape_of(plain);
    for (double x = -0.55; x < 3; x += 0.25) {
        for (double y = -0.8; y < 1; y += 0.2) {
            for (double z = -0.8; z < 1; z += 0.2) {
                EXPECT_NEAR(shape->distance_mm({x, y, z}), exact->distance_mm({x, y, z}), 1e-12)
                    << x << y << z;
            }
        }
    }
}

TEST(MeshShape, a_mesh_inside_out_is_turned_and_split_vertices_are_joined) {
    TriangleMesh turned = box_mesh({{0, 0, 0}, {2, 2, 2}});
    for (Triangle& t : turned.triangles) std::swap(t[0], t[1]);
    EXPECT_DOUBLE_EQ(shape_of(turned)->distance_mm({1, 1, 1.5}), -0.5);
    TriangleMesh soup;
    const TriangleMesh box = box_mesh({{0, 0, 0}, {2, 2, 2}});
    for (const Triangle& t : box.triangles) {
        const auto n = static_cast<std::uint32_t>(soup.positions.size());
        for (const std::uint32_t corner : t) soup.positions.push_back(box.positions[corner]);
        soup.triangles.push_back({n, n + 1, n + 2});
    }
    EXPECT_DOUBLE_EQ(shape_of(soup)->distance_mm({1, 1, 3}), 1);
}

TEST(MeshShape, refuses_a_mesh_that_bounds_no_solid) {
    TriangleMesh open = box_mesh({{0, 0, 0}, {2, 2, 2}});
    open.triangles.pop_back();
    auto made = MeshShape::make(open);
    ASSERT_FALSE(made.has_value());
    EXPECT_NE(made.error().cause.find("3 edges do not have two triangles, the first at"), std::string::npos);
    TriangleMesh flipped = box_mesh({{0, 0, 0}, {2, 2, 2}});
    std::swap(flipped.triangles[3][0], flipped.triangles[3][1]);
    made = MeshShape::make(flipped);
    ASSERT_FALSE(made.has_value());
    EXPECT_NE(made.error().cause.find("turned over"), std::string::npos);
    made = MeshShape::make(box_mesh({{0, 0, 0}, {2, 2, 0}}));
    ASSERT_FALSE(made.has_value());
    EXPECT_FALSE(MeshShape::make({}).has_value());
}

}  // namespace
}  // namespace tribo::field
