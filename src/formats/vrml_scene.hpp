// SPDX-License-Identifier: MIT
// What of a VRML tree is seen, as one model.
#pragma once

#include "formats/model.hpp"
#include "formats/vrml_tree.hpp"

namespace tribo::formats {

// Triangles of all that is seen from the roots, in world space. Triangles, nodes and nesting are counted
// before anything is made of them. Adds to tree.warnings.
Result<Model> read_vrml_scene(VrmlTree& tree, const ModelOptions& options);

}  // namespace tribo::formats
