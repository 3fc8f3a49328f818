// SPDX-License-Identifier: MIT
// The triangles of one IndexedFaceSet, in its own frame.
#pragma once

#include "base/mesh.hpp"
#include "formats/model_polygon.hpp"
#include "formats/vrml_tree.hpp"

namespace tribo::formats {

struct VrmlFaces {
    std::vector<Vec3> points;         // used ones only, so that placing them costs what they show
    std::vector<Triangle> triangles;  // counter-clockwise seen from outside
    double crease_angle_rad = 0;
    bool solid = true;
};

// How many triangles the node gives at most: corners less two of each face.
std::uint64_t count_triangles(const VrmlTree& tree, VrmlNodeId face_set);

// `text` is what the tree was read from, to find the line of a wrong index. Allocates in proportion to the
// corners, not to the points of a Coordinate that many face sets share.
Result<VrmlFaces> read_vrml_faces(const VrmlTree& tree, VrmlNodeId face_set, std::string_view text,
                                  PolygonTriangulator& triangulator);

}  // namespace tribo::formats
