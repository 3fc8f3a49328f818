// SPDX-License-Identifier: MIT
#pragma once

#include "formats/model.hpp"

namespace tribo::formats {

// True for what this reader reads or refuses by name: VRML 2.0, VRML 1.0, Open Inventor, X3D.
bool looks_like_vrml(std::string_view bytes);

// VRML 2.0 (ISO/IEC 14772-1:1997): IndexedFaceSet in world space, under the grouping nodes, with DEF and USE.
// Switch shows the child that whichChoice names, LOD its first level. Nodes that give a surface in another
// way, Inline and PROTO are refused by name where they would be seen; nodes without a surface are passed
// over, unknown ones with a warning. Limits, each reported with its line: 64 MB of text, nesting 256 deep
// (through USE as well), words of 64 kB, kMaxTriangles and four million nodes after unfolding, counted
// beforehand.
Result<Model> read_vrml(std::string_view bytes, const ModelOptions& options);

}  // namespace tribo::formats
