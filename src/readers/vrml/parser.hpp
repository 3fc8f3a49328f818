// SPDX-License-Identifier: MIT
// One VRML 2.0 text to nodes of a tree. The syntax is read without knowledge of the nodes.
#pragma once

#include "readers/vrml/files.hpp"

namespace tribo::readers {

// Reads the text of tree.files[file], after its header line.
Result<VrmlTop> parse_vrml(VrmlTree& tree, VrmlFiles& files, std::uint32_t file);

}  // namespace tribo::readers
