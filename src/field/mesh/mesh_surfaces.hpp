// SPDX-License-Identifier: MIT
// Makes surfaces out of the triangles of other people, where these do not say what is connected: some are
// there twice, or more than two meet at an edge.
#pragma once

#include "base/mesh.hpp"

namespace tribo::field {

// Keeps one of equal triangles. But where closed bodies share one and one of them is inside out, as a half
// beside its mirror image, that one is turned first. Of two triangles that differ in their side only, as at
// the wall between two blocks, it drops both if what is left encloses a volume; else it keeps one. Returns
// true if it has: that surface was there with both sides. The mesh is welded.
bool drop_twins(TriangleMesh& mesh);

// Where more than two triangles meet at an edge, connects the pairs that go on most straight with their
// fronts on one side, and leaves the others with an end there. Connected triangles then share their vertices
// and no others do. A mesh without such edges stays as it is.
void part_at_crowded_edges(TriangleMesh& mesh);

}  // namespace tribo::field
