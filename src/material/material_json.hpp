// SPDX-License-Identifier: MIT
// Material files: JSON, described in docs/material.md.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "files/files.hpp"
#include "material/material.hpp"

namespace tribo::material {

inline constexpr std::uint64_t kLargestMaterialBytes = std::uint64_t{16} << 20;

// Strict: every key must be known, every number in range, models in order and stable. Never throws.
Result<Material> parse_material(std::string_view text, const std::string& source_name);

// Reads a file. `image` stays relative to the file.
FileResult<Material> read_material(const std::string& path);

// Returns the text that parse_material() reads back to the same material. It ends with a line end.
std::string material_json(const Material& material);

// True when the JSON text claims to be a material; its other contents may be wrong.
bool looks_like_material(std::string_view text);

}  // namespace tribo::material
