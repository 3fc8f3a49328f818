// SPDX-License-Identifier: MIT
// The winding number by crossings against the sum of solid angles, on meshes that fold over themselves.
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "field/mesh/mesh_tree.hpp"
#include "mesh_samples.hpp"

namespace tribo::field {
namespace {

// Corners and points on a coarse lattice: points lie above corners, edges and upright triangles all the time.
RC_GTEST_PROP(MeshWinding, is_the_solid_angle_of_any_watertight_mesh, ()) {
    const auto coordinate =
        rc::gen::map(rc::gen::inRange(-6, 7), [](int i) { return 0.5F * static_cast<float>(i); });
    TriangleMesh mesh = test::sphere_mesh({}, 1, 1);
    for (Point3f& p : mesh.positions) p = {*coordinate, *coordinate, *coordinate};
    const MeshTree tree(mesh);
    for (int n = 0; n < 50; ++n) {
        const Point3f at{*coordinate, *coordinate, *coordinate};
        const Vec3 p{at[0], at[1], at[2]};
        if (tree.nearest(p).at.squared_mm2 < 1e-12) continue;  // on the surface there is no side
        const double turns = test::turns_about(mesh, p);
        RC_ASSERT(std::abs(turns - std::round(turns)) < 1e-6);
        RC_ASSERT(tree.winding(p) == static_cast<int>(std::round(turns)));
    }
}

}  // namespace
}  // namespace tribo::field
