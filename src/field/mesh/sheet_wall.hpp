// SPDX-License-Identifier: MIT
// The wall along the border of a sheet that has been given a thickness.
#pragma once

#include <vector>

#include "base/mesh.hpp"
#include "field/mesh/mesh_normals.hpp"

namespace tribo::field {

struct SheetWall {
    TriangleMesh mesh;      // corners are not shared
    std::vector<Vec3> off;  // by triangle: out of the sheet, unit
};

// The wall is where the nearest place of an open mesh comes to be on its border: behind each of the border's
// edges, and, where two faces meet at a corner of the border, the sector between the ways behind them.
// Behind: against the normals, up to `thickness_mm`. Where the border bends, walls of two edges may cross,
// and go on into the sheet or into the air.
SheetWall wall_of_sheet(const TriangleMesh& mesh, const MeshNormals& normals, double thickness_mm);

}  // namespace tribo::field
