// SPDX-License-Identifier: MIT
// The JSON output of Tribo: keys in the order in which they are set, no nulls, text always valid UTF-8. It
// includes the JSON library; of the headers of files/ only this one and json_section.hpp do.
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
// Indented, with arrays of plain values on one line. Ends with a line end.
std::string pretty(const Json& json);

}  // namespace tribo::files
