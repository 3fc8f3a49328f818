// SPDX-License-Identifier: MIT
// What of a VRML tree is seen, as one model.
#pragma once

#include "readers/mesh/model.hpp"
#include "readers/vrml/tree.hpp"

namespace tribo::readers {

// Triangles of all that is seen from the roots, in world space. Triangles, nodes and nesting are counted
// before anything is made of them. Adds to tree.warnings.
Result<Model> read_vrml_scene(VrmlTree& tree, const ModelOptions& options);

}  // namespace tribo::readers
