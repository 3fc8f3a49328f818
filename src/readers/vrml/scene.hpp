// SPDX-License-Identifier: MIT
// The visible geometry of a VRML tree, as one model.
#pragma once

#include "readers/mesh/model.hpp"
#include "readers/vrml/tree.hpp"

namespace tribo::readers {

// Returns the triangles of all visible geometry below the roots, in world space. Triangles, nodes and nesting
// are counted before anything is allocated for them. Adds to tree.warnings.
Result<Model> read_vrml_scene(VrmlTree& tree, const ModelOptions& options);

}  // namespace tribo::readers
