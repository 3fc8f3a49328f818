// SPDX-License-Identifier: MIT
// Checks a glTF file before the library reads it.
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"

namespace tribo::files {

// Walks the JSON of a .gltf or .glb file once and keeps only its list of buffers. Refuses broken JSON,
// nesting that would exhaust the stack of the library (it uses recursion), data in other files, and more than
// one buffer for the binary chunk, because each would be a copy.
Result<void> check_gltf_document(std::string_view bytes, const std::string& source_name);

}  // namespace tribo::files
