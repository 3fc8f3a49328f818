// SPDX-License-Identifier: MIT
// How Tribo writes JSON: keys in the order in which they are set, no nulls, text always valid UTF-8.
// It brings in the JSON library: no header of files/ but this one and json_section.hpp includes it.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/vec3.hpp"

namespace tribo::files {

using Json = nlohmann::ordered_json;

// Sets a key unless the value is absent or not finite.
inline void set(Json& object, const char* key, std::optional<double> value) {
    if (value && std::isfinite(*value)) object[key] = *value;
}
inline Json triple(Vec3 v) {
    return Json::array({v.x, v.y, v.z});
}
// One line. Bytes that are not UTF-8 (a Latin-1 comment in a program) become replacement characters.
inline std::string dump(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}
// Indented, but arrays of plain values on one line; ends with a line end.
std::string pretty(const Json& json);

}  // namespace tribo::files
