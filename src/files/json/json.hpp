// SPDX-License-Identifier: MIT
// The JSON output of Tribo: keys in the order in which they are set, no nulls, text always valid UTF-8. It
// includes the JSON library; of the headers of files/ only this one and json_section.hpp do.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

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
// Reads a text. The result is_discarded() if it is no JSON.
Json parse(std::string_view text);
// One line. Bytes that are not UTF-8 (a Latin-1 comment in a program) become replacement characters.
std::string dump(const Json& json);
// Indented, with arrays of plain values on one line. Ends with a line end.
std::string pretty(const Json& json);

}  // namespace tribo::files

// Compiled once, in json.cpp.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;
