// SPDX-License-Identifier: MIT
// A material as the text of its file, without a JSON library: for learn.wasm and material_json.
#pragma once

#include <string>

#include "material/material.hpp"

namespace tribo::material {

// One line of JSON. Bytes that are not UTF-8 become replacement characters. Numbers are finite.
std::string material_text(Material material);

}  // namespace tribo::material
