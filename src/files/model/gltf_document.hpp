// SPDX-License-Identifier: MIT
// A glTF file as a document: its check before the library reads it, and the names in those of Tribo.
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"

namespace tribo::files {

// A file whose generator this is has triangles of untouched stock in a material of this name.
inline constexpr const char* kOwnGenerator = "Tribo";
inline constexpr const char* kStockMaterial = "stock";

// Walks the JSON of a .gltf or .glb file once and keeps only its list of buffers. Refuses broken JSON,
// nesting that would exhaust the stack of the library (it uses recursion), data in other files, and more than
// one buffer for the binary chunk, because each would be a copy.
Result<void> check_gltf_document(std::string_view bytes, const std::string& source_name);

}  // namespace tribo::files
