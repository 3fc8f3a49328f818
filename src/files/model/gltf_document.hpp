// SPDX-License-Identifier: MIT
// What must hold of a glTF file before its library may see it.
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"

namespace tribo::files {

// Walks the JSON of a .gltf or .glb file once, keeping nothing of it but its list of buffers. Refuses broken
// JSON, nesting that would exhaust the stack of the library's recursion, data in other files, and more than
// one buffer that stands for the binary chunk, of which each would be a copy.
Result<void> check_gltf_document(std::string_view bytes, const std::string& source_name);

}  // namespace tribo::files
