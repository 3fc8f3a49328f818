// SPDX-License-Identifier: MIT
#pragma once

#include "readers/mesh/model.hpp"

namespace tribo::readers {

// True for formats that this reader reads or refuses by name: VRML 2.0, VRML 1.0, Open Inventor, X3D.
bool looks_like_vrml(std::string_view bytes);

// VRML 2.0 (ISO/IEC 14772-1:1997): all geometry that has a surface, in world space, under the grouping nodes,
// with DEF and USE, prototypes, and Inline and EXTERNPROTO through options.neighbours.
// - Switch shows the child of whichChoice, LOD its first level.
// - Nodes without a surface are skipped. Unknown nodes, and nodes of a missing EXTERNPROTO, are skipped
//   with a warning. An Inline that cannot be read is refused if it would be visible.
// - Curved shapes become flat sides (kVrmlSides). Colours are those of Color nodes, else of the Material.
// - Limits, each reported with its line: 64 MB of text in 1000 files, 8 deep, 100 of them named by one node,
//   100,000 Inline nodes; nesting 256 deep (also through USE); prototypes of 1000 fields, 32 deep, unfolding
//   to 4 million nodes and fields; words of 64 kB; the triangles of the options, four million nodes, and
//   indices and colours as scene.cpp says, in all and counted beforehand.
Result<Model> read_vrml(std::string_view bytes, const ModelOptions& options);

}  // namespace tribo::readers
